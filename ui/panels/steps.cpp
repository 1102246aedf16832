#include <imgui.h>

#include <algorithm>

#include "app/step.h"
#include "render/number_text.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace adit::ui {
namespace {

using Outcome = app::JobRunner::Outcome;

struct StepWords {
  std::string words;
  ImVec4 colour;
};

StepWords words_of(const app::Step& step, const app::JobState& state) {
  if (!step.wanted(state)) return {"not part of this job", theme::quiet};
  for (const StepTime& time : state.results.timing) {
    if (time.step != step.name) continue;
    if (time.fresh) return {"up to date", theme::good};
    return {"ran in " + render::fixed(time.seconds, 1) + " s", theme::good};
  }
  return {"to be run", theme::doubt};
}

StepWords words_while_running(double fraction, double begin, double end) {
  if (fraction >= end) return {begin < end ? "done" : "not part of this job", theme::quiet};
  if (fraction >= begin) return {"running", theme::accent};
  return {"waiting", theme::quiet};
}

StepWords words_of(const Workspace& workspace, const app::Step& step, std::size_t i) {
  const auto& state = workspace.state();
  if (state == nullptr) return {"\u2013", theme::quiet};
  if (workspace.doing() != Workspace::Doing::running) return words_of(step, *state);
  const std::vector<double> bounds = app::step_bounds(*state);
  return words_while_running(workspace.fraction(), bounds[i], bounds[i + 1]);
}

void draw_states(const Workspace& workspace) {
  if (!ImGui::BeginTable("steps", 2, ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchSame)) return;
  const std::vector<app::Step> steps = app::all_steps();
  for (std::size_t i = 0; i < steps.size(); ++i) {
    cell(steps[i].name);
    const StepWords words = words_of(workspace, steps[i], i);
    ImGui::TableNextColumn();
    ImGui::TextColored(words.colour, "%s", words.words.c_str());
  }
  ImGui::EndTable();
}

void draw_buttons(Workspace& workspace) {
  const auto doing = workspace.doing();
  const float width = (ImGui::GetContentRegionAvail().x - 2.0F * ImGui::GetStyle().ItemSpacing.x) / 3.0F;
  if (button(workspace.script(), "Run", doing == Workspace::Doing::nothing, width)) workspace.run();
  ImGui::SameLine();
  const bool can_cancel = doing != Workspace::Doing::nothing && !workspace.cancelling();
  if (button(workspace.script(), "Cancel", can_cancel, width)) workspace.cancel();
  ImGui::SameLine();
  if (button(workspace.script(), "Close job", doing == Workspace::Doing::nothing, width)) workspace.close();
}

void draw_progress(const Workspace& workspace) {
  if (workspace.doing() == Workspace::Doing::nothing) return;
  const std::string percent = render::fixed(100.0 * workspace.fraction(), 0) + " %";
  ImGui::ProgressBar(static_cast<float>(workspace.fraction()), ImVec2(-1.0F, 0.0F), percent.c_str());
  remark(workspace.cancelling() ? "stopping: " + workspace.message() : workspace.message());
}

void draw_outcome(const Workspace& workspace) {
  if (workspace.outcome() == Outcome::cancelled) ImGui::TextColored(theme::doubt, "cancelled; finished steps are kept");
  const auto& state = workspace.state();
  if (workspace.outcome() == Outcome::done && state) {
    const bool person = needs_a_person(state->results);
    ImGui::TextColored(person ? theme::bad : theme::good, "%s", person ? "done; findings need a person" : "done");
    remark((state->out / "report.pdf").string());
  }
  if (workspace.error().empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, theme::bad);
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(workspace.error().c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

}  // namespace

void draw_steps(Workspace& workspace) {
  heading("Steps");
  draw_states(workspace);
  ImGui::Spacing();
  draw_buttons(workspace);
  draw_progress(workspace);
  draw_outcome(workspace);
}

}  // namespace adit::ui
