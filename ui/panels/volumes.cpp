#include <imgui.h>

#include "render/number_text.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

using render::fixed;
using render::percent;

std::string with_sigma(double value_m3, double sigma_m3) {
  return fixed(value_m3, 1) + " \u00b1 " + fixed(2.0 * sigma_m3, 1);
}

std::string line_name(const Volume& v) {
  return v.line + (v.line_offset_m != 0.0 ? " (" + render::with_sign(v.line_offset_m, 2) + " m)" : "");
}

void amount_cells(const Volume& v) {
  number_cell(fixed(v.slices.design_m3, 1));
  number_cell(with_sigma(v.slices.excavated_m3, v.sigma_excavated_m3));
  number_cell(with_sigma(v.slices.overbreak_m3, v.sigma_overbreak_m3));
  number_cell(with_sigma(v.slices.underbreak_m3, v.sigma_underbreak_m3));
  ImGui::PushStyleColor(ImGuiCol_Text, v.coverage < 0.8 ? theme::bad : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  number_cell(percent(v.coverage, 1));
  ImGui::PopStyleColor();
}

void draw_lines(const std::vector<Volume>& lines) {
  heading("Lines, chainage " + fixed(lines.front().from_m, 2) + " to " + fixed(lines.front().to_m, 2));
  if (!begin_table("lines", {"line", "design m\u00b3", "excavated m\u00b3", "overbreak m\u00b3", "underbreak m\u00b3",
                             "measured", "interpolated m\u00b2", "not seen m\u00b2"}))
    return;
  for (const Volume& v : lines) {
    cell(line_name(v));
    amount_cells(v);
    number_cell(fixed(v.interpolated_m2, 1));
    number_cell(fixed(v.unseen_m2, 1));
  }
  ImGui::EndTable();
}

void draw_methods(const std::vector<Volume>& lines) {
  heading("Other methods, for comparison");
  if (!begin_table("methods", {"line", "method", "excavated m\u00b3", "overbreak m\u00b3", "underbreak m\u00b3"}))
    return;
  for (const Volume& v : lines)
    for (const auto& [name, amounts] :
         {std::pair("average end area", v.average_end_area), std::pair("prismoidal", v.prismoidal)}) {
      cell(line_name(v));
      cell(name);
      for (const double value : {amounts.excavated_m3, amounts.overbreak_m3, amounts.underbreak_m3})
        number_cell(fixed(value, 1));
    }
  ImGui::EndTable();
}

void draw_rounds(Workspace& workspace, const std::vector<RoundVolume>& rounds) {
  heading("Rounds, against " + rounds.front().volume.line);
  if (!begin_table("rounds", {"round", "from", "to", "drilled m", "design m\u00b3", "excavated m\u00b3",
                              "overbreak m\u00b3", "underbreak m\u00b3", "measured"}))
    return;
  for (const RoundVolume& round : rounds) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    if (selectable_row(workspace.script(), "round " + std::to_string(round.number), false))
      workspace.show_chainage((round.volume.from_m + round.volume.to_m) / 2.0);
    number_cell(fixed(round.volume.from_m, 2));
    number_cell(fixed(round.volume.to_m, 2));
    number_cell(round.drilled_m > 0.0 ? fixed(round.drilled_m, 2) : "\u2013");
    amount_cells(round.volume);
  }
  ImGui::EndTable();
}

}  // namespace

void draw_volumes(Workspace& workspace) {
  const auto state = workspace.state();
  if (state == nullptr || !state->results.volume || state->results.volume->lines.empty()) {
    nothing_yet(state != nullptr && !state->has_design() ? "The job has no alignment and profile."
                                                         : "The volumes have not been computed yet.");
    return;
  }
  const VolumeResult& volume = *state->results.volume;
  ImGui::BeginChild("volumes");
  draw_lines(volume.lines);
  remark("Thin slices with plan curvature; \u00b1 is two standard deviations (95 %).");
  ImGui::Spacing();
  if (!volume.rounds.empty()) draw_rounds(workspace, volume.rounds);
  ImGui::Spacing();
  draw_methods(volume.lines);
  ImGui::EndChild();
}

}  // namespace adit::ui
