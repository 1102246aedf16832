#include "ui/widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/theme.h"

namespace adit::ui {
namespace {

WidgetPlace place_of_last(bool enabled = true) {
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  return {from.x, from.y, to.x, to.y, enabled};
}

}  // namespace

bool button(Script& script, const std::string& label, bool enabled, float width_px) {
  ImGui::BeginDisabled(!enabled);
  const bool by_mouse = ImGui::Button(label.c_str(), ImVec2(width_px, 0.0F));
  ImGui::EndDisabled();
  return script.clicks(label, place_of_last(enabled)) || by_mouse;
}

bool choice(Script& script, const std::string& label, bool chosen) {
  const bool by_mouse = ImGui::RadioButton(label.c_str(), chosen);
  return script.clicks(label, place_of_last()) || by_mouse;
}

bool selectable_row(Script& script, const std::string& label, bool selected) {
  const bool by_mouse = ImGui::Selectable(label.c_str(), selected, ImGuiSelectableFlags_SpanAllColumns);
  return script.clicks(label, place_of_last()) || by_mouse;
}

bool slider(Script& script, const std::string& label, int& value, int first, int last, const std::string& words) {
  std::string shown;  // ImGui takes it as a format
  for (const char c : words) shown += c == '%' ? std::string("%%") : std::string(1, c);
  const bool by_mouse = ImGui::SliderInt(label.c_str(), &value, first, last, shown.c_str(), ImGuiSliderFlags_NoInput);
  const auto by_script = script.sets(label, place_of_last());
  if (by_script) value = std::clamp(static_cast<int>(std::lround(*by_script)), first, last);
  return by_mouse || by_script.has_value();
}

bool begin_tab(Script& script, const std::string& label) {
  // Whether the script wants this tab must be known before it is drawn; its place follows after.
  const bool wanted = script.clicks(label, script.place(label).value_or(WidgetPlace{}));
  const bool open =
      ImGui::BeginTabItem(label.c_str(), nullptr, wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None);
  script.note(label, place_of_last());
  return open;
}

void remark(const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::quiet);
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

void heading(const std::string& words) {
  const BoldText bold;
  ImGui::TextUnformatted(words.c_str());
}

void nothing_yet(const std::string& words) {
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  const ImVec2 at = ImGui::GetCursorPos();
  ImGui::SetCursorPos({at.x + std::max(0.0F, (room.x - size.x) / 2.0F), at.y + 0.4F * room.y});
  ImGui::PushStyleColor(ImGuiCol_Text, theme::quiet);
  ImGui::TextUnformatted(words.c_str());
  ImGui::PopStyleColor();
}

bool begin_table(const char* name, std::initializer_list<const char*> columns) {
  constexpr ImGuiTableFlags flags =
      ImGuiTableFlags_Borders | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX;
  if (!ImGui::BeginTable(name, static_cast<int>(columns.size()), flags)) return false;
  for (const char* column : columns) ImGui::TableSetupColumn(column);
  ImGui::TableHeadersRow();
  return true;
}

void cell(const std::string& words) {
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(words.c_str());
}

void number_cell(const std::string& words) {
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(words.c_str()).x;
  if (room > 0.0F) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
  ImGui::TextUnformatted(words.c_str());
}

}  // namespace adit::ui
