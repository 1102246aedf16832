#include <imgui.h>

#include "render/colour_map.h"
#include "render/number_text.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

const PlacedScan* placed_scan(const app::JobState& state, std::size_t i) {
  const auto& scans = state.results.registration.scans;
  return i < scans.size() ? &scans[i] : nullptr;
}

std::string points_words(const app::JobState& state, std::size_t i) {
  const auto& scans = state.results.import.scans;
  return i < scans.size() ? render::grouped(scans[i].points) : std::string("\u2013");
}

void placed_cell(const PlacedScan* scan) {
  ImGui::TableNextColumn();
  if (scan == nullptr) {
    ImGui::TextColored(theme::quiet, "not yet");
  } else if (!scan->placed) {
    ImGui::TextColored(theme::bad, "not placed");
  } else if (!scan->undetermined.empty()) {
    ImGui::TextColored(theme::bad, "%s unknown", scan->undetermined.front().c_str());
  } else {
    ImGui::TextColored(theme::good, "%s", scan->placed_by.c_str());
  }
}

void scan_row(Workspace& workspace, const app::JobState& state, std::size_t i) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool selected = workspace.scan() == i;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = 0.62F * ImGui::GetTextLineHeight();
  if (selectable_row(workspace.script(), "    " + state.job.scans[i].name, selected))
    workspace.select_scan(selected ? std::nullopt : std::optional(i));
  const float top = at.y + (ImGui::GetTextLineHeight() - side) / 2.0F;
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side}, packed(render::scan_colour(i)),
                                            2.0F);
  number_cell(points_words(state, i));
  const PlacedScan* placed = placed_scan(state, i);
  placed_cell(placed);
  if (placed != nullptr && placed->placed) {
    const PoseSigma& s = placed->sigma;
    number_cell(render::fixed(1e3 * s.along_m, 1) + " " + render::fixed(1e3 * s.across_m, 1) + " " +
                render::fixed(1e3 * s.up_m, 1));
  }
}

void draw_scans(Workspace& workspace, const app::JobState& state) {
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_BordersInnerH;
  if (!ImGui::BeginTable("scans", 4, flags)) return;
  const auto column = [](const char* name, float share) {
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, share);
  };
  column("    scan", 0.8F);
  column("points", 1.1F);
  column("placed by", 1.6F);
  column("\u03c3 mm", 1.1F);
  ImGui::TableHeadersRow();
  if (ImGui::IsItemHovered())  // the last header
    ImGui::SetTooltip("standard deviation along, across, up");
  for (std::size_t i = 0; i < state.job.scans.size(); ++i) scan_row(workspace, state, i);
  ImGui::EndTable();
}

const char* word_of(Severity severity) {
  switch (severity) {
    case Severity::decision:
      return "decide";
    case Severity::warning:
      return "warning";
    case Severity::note:
      break;
  }
  return "note";
}

void draw_finding(const Finding& finding) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour_of(finding.severity));
  heading(std::string(word_of(finding.severity)) + ": " + finding.subject);
  ImGui::PopStyleColor();
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(finding.words.c_str());
  ImGui::PopTextWrapPos();
  if (!finding.mend.empty()) remark(finding.mend);
  ImGui::Spacing();
}

void draw_findings(const app::JobState& state) {
  heading("Findings");
  if (state.results.timing.empty()) {
    remark("none yet: the job has not been run");
    return;
  }
  const Findings findings = all_findings(state.results);
  if (findings.empty()) ImGui::TextColored(theme::good, "none");
  for (const Severity severity : {Severity::decision, Severity::warning, Severity::note})
    for (const Finding& finding : findings)
      if (finding.severity == severity) draw_finding(finding);
}

std::string people(const Job& job) {
  std::string words = job.client;
  if (!job.client.empty() && !job.surveyor.empty()) words += "; ";
  return words + job.surveyor;
}

}  // namespace

void draw_job(Workspace& workspace) {
  const auto state = workspace.state();
  if (state == nullptr) {
    heading(workspace.job_path().filename().string());
    const bool reading = workspace.doing() == Workspace::Doing::taking_up;
    remark(reading ? "reading the job" : "the job has not been read");
  } else {
    heading(state->job.name.empty() ? "job without a name" : state->job.name);
    if (const std::string words = people(state->job); !words.empty()) remark(words);
    ImGui::Spacing();
    draw_scans(workspace, *state);
    ImGui::Spacing();
    draw_findings(*state);
  }
}

}  // namespace adit::ui
