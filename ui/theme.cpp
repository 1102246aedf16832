#include "ui/theme.h"

#include <filesystem>

namespace adit::ui {
namespace {

constexpr float text_px = 14.5F;

// Latin, Greek, Cyrillic, punctuation, super- and subscripts, arrows, mathematical signs, shapes.
constexpr ImWchar glyphs[] = {0x0020, 0x017F, 0x0370, 0x03FF, 0x0400, 0x04FF, 0x2010, 0x2044, 0x2070, 0x209C,
                              0x2190, 0x21FF, 0x2200, 0x22FF, 0x25A0, 0x25FF, 0x2713, 0x2717, 0};

void add_font(const char* name, float size_px) {
  const std::filesystem::path folders[] = {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/TTF",
                                           "/usr/share/fonts/dejavu-sans-fonts"};
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  for (const auto& folder : folders) {
    const std::filesystem::path file = folder / name;
    if (!std::filesystem::exists(file)) continue;
    if (atlas.AddFontFromFileTTF(file.c_str(), size_px, nullptr, glyphs) != nullptr) return;
  }
  ImFontConfig own;
  own.SizePixels = size_px;
  atlas.AddFontDefault(&own);
}

void set_colours(ImGuiStyle& style) {
  ImGui::StyleColorsLight(&style);
  style.Colors[ImGuiCol_Text] = {0.10F, 0.11F, 0.13F, 1.0F};
  style.Colors[ImGuiCol_WindowBg] = {0.955F, 0.96F, 0.965F, 1.0F};
  style.Colors[ImGuiCol_ChildBg] = {0.0F, 0.0F, 0.0F, 0.0F};
  style.Colors[ImGuiCol_Border] = {0.80F, 0.82F, 0.84F, 1.0F};
  style.Colors[ImGuiCol_FrameBg] = theme::paper;
  style.Colors[ImGuiCol_Button] = {0.86F, 0.89F, 0.93F, 1.0F};
  style.Colors[ImGuiCol_ButtonHovered] = {0.76F, 0.84F, 0.93F, 1.0F};
  style.Colors[ImGuiCol_ButtonActive] = {0.64F, 0.77F, 0.91F, 1.0F};
  style.Colors[ImGuiCol_PlotHistogram] = theme::accent;
  style.Colors[ImGuiCol_CheckMark] = theme::accent;
  style.Colors[ImGuiCol_SliderGrab] = theme::accent;
  style.Colors[ImGuiCol_Tab] = {0.88F, 0.90F, 0.92F, 1.0F};
  style.Colors[ImGuiCol_TabActive] = theme::paper;
  style.Colors[ImGuiCol_TabHovered] = {0.80F, 0.87F, 0.95F, 1.0F};
  style.Colors[ImGuiCol_TableHeaderBg] = {0.89F, 0.91F, 0.93F, 1.0F};
  style.Colors[ImGuiCol_TableBorderLight] = {0.88F, 0.89F, 0.90F, 1.0F};
  style.Colors[ImGuiCol_TableBorderStrong] = {0.80F, 0.82F, 0.84F, 1.0F};
}

}  // namespace

void apply_theme(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  add_font("DejaVuSans.ttf", text_px * scale);
  add_font("DejaVuSans-Bold.ttf", text_px * scale);
  ImGuiStyle style;
  set_colours(style);
  style.WindowRounding = 0.0F;
  style.FrameRounding = 3.0F;
  style.FrameBorderSize = 1.0F;
  style.FramePadding = {7.0F, 4.0F};
  style.ItemSpacing = {8.0F, 6.0F};
  style.CellPadding = {6.0F, 3.0F};
  style.WindowPadding = {10.0F, 9.0F};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

float scale_of_theme() {
  return ImGui::GetIO().Fonts->Fonts.front()->FontSize / text_px;
}

BoldText::BoldText() {
  ImGui::PushFont(ImGui::GetIO().Fonts->Fonts.back());
}
BoldText::~BoldText() {
  ImGui::PopFont();
}

ImVec4 colour_of(Severity severity) {
  switch (severity) {
    case Severity::decision:
      return theme::bad;
    case Severity::warning:
      return theme::doubt;
    case Severity::note:
      break;
  }
  return theme::quiet;
}

ImU32 packed(const render::Colour& c) {
  return packed(ImVec4(static_cast<float>(c.red), static_cast<float>(c.green), static_cast<float>(c.blue),
                       static_cast<float>(c.alpha)));
}

ImU32 packed(const ImVec4& colour) {
  return ImGui::ColorConvertFloat4ToU32(colour);
}

}  // namespace adit::ui
