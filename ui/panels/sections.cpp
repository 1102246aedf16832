#include "ui/panels/sections.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "render/number_text.h"
#include "render/section_drawing.h"
#include "ui/paper.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

using render::fixed;

void draw_cursor(Workspace& workspace, const std::vector<Section>& sections) {
  Script& script = workspace.script();
  auto index = static_cast<int>(*workspace.section_index());
  const int last = static_cast<int>(sections.size()) - 1;
  const float button_px = 90.0F * scale_of_theme();
  if (button(script, "Previous", index > 0, button_px)) workspace.previous_section();
  ImGui::SameLine();
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button_px - ImGui::GetStyle().ItemSpacing.x);
  if (slider(script, "##section", index, 0, last, render::section_title(*workspace.section())))
    workspace.show_section(static_cast<std::size_t>(index));
  ImGui::SameLine();
  if (button(script, "Next", index < last, button_px)) workspace.next_section();
}

std::string most(double value_m, double p_m) {
  return value_m > 0.0 ? fixed(value_m, 3) + " at p " + fixed(p_m, 1) : std::string("0.000");
}

void row(const char* name, const std::vector<SectionAreas>& lines, std::string (*words)(const SectionAreas&)) {
  cell(name);
  for (const SectionAreas& line : lines) number_cell(words(line));
}

void draw_numbers(const std::vector<SectionAreas>& lines) {
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("areas", 1 + static_cast<int>(lines.size()), flags)) return;
  ImGui::TableSetupColumn("against line");
  for (const SectionAreas& line : lines) ImGui::TableSetupColumn(line.line.c_str());
  ImGui::TableHeadersRow();
  using Areas = SectionAreas;
  row("offset m", lines, [](const Areas& a) { return render::with_sign(a.line_offset_m, 3); });
  row("design m\u00b2", lines, [](const Areas& a) { return fixed(a.design_area_m2, 2); });
  row("excavated m\u00b2", lines, [](const Areas& a) { return fixed(a.area_m2, 2); });
  row("overbreak m\u00b2", lines, [](const Areas& a) { return fixed(a.overbreak_m2, 2); });
  row("underbreak m\u00b2", lines, [](const Areas& a) { return fixed(a.underbreak_m2, 2); });
  row("most over m", lines, [](const Areas& a) { return most(a.max_overbreak_m, a.max_overbreak_p_m); });
  row("most under m", lines, [](const Areas& a) { return most(a.max_underbreak_m, a.max_underbreak_p_m); });
  row("measured", lines, [](const Areas& a) { return render::percent(a.coverage); });
  row("interpolated", lines, [](const Areas& a) { return render::percent(a.interpolated); });
  ImGui::EndTable();
}

}  // namespace

void SectionPanel::draw_sheet(const Workspace& workspace, const ImVec2& size) {
  const std::size_t index = *workspace.section_index();
  const bool shown = state_ == workspace.state() && index_ == index && size_.x == size.x && size_.y == size.y;
  if (!shown || sheet_.empty()) {
    state_ = workspace.state();
    index_ = index;
    size_ = size;
    const Paper paper = paper_of(size, scale_of_theme());
    const Section& section = *workspace.section();
    auto canvas = render::Canvas::raster(paper.width_mm, paper.height_mm, paper.dots_per_inch);
    const auto lines = state_->design ? render::section_lines(*state_->design, section.chainage_m)
                                      : std::vector<render::SectionLine>{};
    render::draw_section(canvas, paper.rect().inset(3.0), section, lines);
    sheet_ = Texture(canvas.finish_picture());
  }
  ImGui::Image(sheet_.id(), sheet_.size());
}

void SectionPanel::draw(Workspace& workspace) {
  const auto state = workspace.state();
  const std::vector<Section>* sections = sections_of(state.get());
  if (sections == nullptr) {
    nothing_yet(state != nullptr && !state->has_design() ? "The job has no alignment and profile."
                                                         : "No sections have been cut yet.");
    return;
  }
  draw_cursor(workspace, *sections);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float numbers_px = std::min(430.0F * scale_of_theme(), 0.45F * room.x);
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const ImVec2 sheet(std::floor(room.x - numbers_px - spacing), std::floor(room.y));
  if (sheet.x < 64.0F || sheet.y < 64.0F) return;
  draw_sheet(workspace, sheet);
  ImGui::SameLine();
  ImGui::BeginChild("numbers", {numbers_px, room.y});
  draw_numbers(workspace.section()->lines);
  remark("Page up and page down go from section to section.");
  ImGui::EndChild();
}

}  // namespace adit::ui
