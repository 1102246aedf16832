#include <imgui.h>

#include "core/foundation/angle.h"
#include "render/number_text.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

using render::fixed;
using render::with_sign;

std::string listed(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all.empty() ? "\u2013" : all;
}

std::string millimetres(double metres) {
  return fixed(1e3 * metres, 1);
}
std::string millidegrees(double radians) {
  return fixed(1e3 * deg_from_rad(radians), 1);
}

void draw_scans(Workspace& workspace, const app::JobState& state) {
  heading("Scans");
  if (!begin_table("scans", {"scan", "placed by", "east", "north", "elevation", "\u03c3 along mm", "across mm", "up mm",
                             "\u03c3 roll m\u00b0", "pitch m\u00b0", "yaw m\u00b0", "unknown"}))
    return;
  const auto& scans = state.results.registration.scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const PlacedScan& scan = scans[i];
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const bool selected = workspace.scan() == i;
    if (selectable_row(workspace.script(), scan.name + "##registration", selected))
      workspace.select_scan(selected ? std::nullopt : std::optional(i));
    cell(scan.placed ? scan.placed_by : "not placed");
    if (!scan.placed) continue;
    const Eigen::Vector3d at = state.results.import.origin.to_site(scan.local_from_scan.translation());
    for (int k = 0; k < 3; ++k) number_cell(fixed(at[k], 3));
    for (const double sigma : {scan.sigma.along_m, scan.sigma.across_m, scan.sigma.up_m})
      number_cell(millimetres(sigma));
    for (const double sigma : {scan.sigma.roll_rad, scan.sigma.pitch_rad, scan.sigma.yaw_rad})
      number_cell(millidegrees(sigma));
    cell(listed(scan.undetermined));
  }
  ImGui::EndTable();
}

void draw_pairs(const std::vector<PairResult>& pairs) {
  heading("Pairs");
  if (!begin_table("pairs", {"source", "target", "overlap", "rms mm", "median mm", "under 6 mm", "\u03c3 along mm",
                             "across mm", "up mm", "unknown", "used"}))
    return;
  for (const PairResult& pair : pairs) {
    cell(pair.source);
    cell(pair.target);
    number_cell(render::percent(pair.overlap));
    number_cell(millimetres(pair.rms_m));
    number_cell(millimetres(pair.median_m));
    number_cell(render::percent(pair.within_6mm));
    for (const double sigma : {pair.sigma.along_m, pair.sigma.across_m, pair.sigma.up_m})
      number_cell(millimetres(sigma));
    cell(listed(pair.undetermined));
    cell(pair.used ? "yes" : "no");
  }
  ImGui::EndTable();
}

void draw_control(const RegistrationResult& registration) {
  heading("Targets against control, rms " + millimetres(registration.control_rms_m) + " mm");
  if (!begin_table("control", {"scan", "target", "east mm", "north mm", "elevation mm", "together mm", "used"})) return;
  for (const ControlResidual& residual : registration.control) {
    cell(residual.scan);
    cell(residual.id);
    for (int k = 0; k < 3; ++k) number_cell(with_sign(1e3 * residual.residual_m[k], 1));
    number_cell(millimetres(residual.residual_m.norm()));
    cell(residual.used ? "yes" : "no");
  }
  ImGui::EndTable();
}

}  // namespace

void draw_registration(Workspace& workspace) {
  const auto state = workspace.state();
  if (state == nullptr || state->results.registration.scans.empty()) {
    nothing_yet("The scans have not been registered yet.");
    return;
  }
  const RegistrationResult& registration = state->results.registration;
  ImGui::BeginChild("registration");
  ImGui::TextColored(registration.accepted ? theme::good : theme::bad, "%s",
                     registration.accepted ? "Accepted: every scan is placed, every direction is determined."
                                           : "Not accepted: the findings name what is to be decided.");
  draw_scans(workspace, *state);
  ImGui::Spacing();
  if (!registration.pairs.empty()) draw_pairs(registration.pairs);
  ImGui::Spacing();
  if (!registration.control.empty()) draw_control(registration);
  ImGui::EndChild();
}

}  // namespace adit::ui
