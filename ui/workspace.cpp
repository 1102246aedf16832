#include "ui/workspace.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace adit::ui {

using Outcome = app::JobRunner::Outcome;

Workspace::Workspace(app::StepContext context, std::filesystem::path out)
    : context_(std::move(context)), out_(std::move(out)) {}

void Workspace::open(const std::filesystem::path& job) {
  close();
  job_path_ = job;
  runner_ = std::make_unique<app::JobRunner>();
  start(Doing::taking_up);
}

void Workspace::close() {
  runner_.reset();  // cancels and waits
  snapshot_ = {};
  doing_ = Doing::nothing;
  cancelling_ = false;
  outcome_ = Outcome::none;
  error_.clear();
  scan_.reset();
  cursor_m_ = 0.0;
}

void Workspace::start(Doing doing) {
  app::RunOptions options;
  options.out = out_;
  options.only_take_up = doing == Doing::taking_up;
  options.context = context_;
  runner_->start(job_path_, options);
  doing_ = doing;
  cancelling_ = false;
  snapshot_ = runner_->poll();
}

void Workspace::run() {
  if (!has_job() || doing_ != Doing::nothing) return;
  outcome_ = Outcome::none;
  error_.clear();
  start(Doing::running);
}

void Workspace::cancel() {
  if (doing_ == Doing::nothing) return;
  cancelling_ = true;
  runner_->cancel();
}

void Workspace::poll() {
  if (!has_job()) return;
  snapshot_ = runner_->poll();
  if (doing_ != Doing::nothing && !snapshot_.running) ended();
}

void Workspace::ended() {
  const bool was_run = doing_ == Doing::running;
  doing_ = Doing::nothing;
  cancelling_ = false;
  if (was_run) outcome_ = snapshot_.outcome;
  if (error_.empty()) error_ = snapshot_.error;
  // A run that was stopped or failed has still finished some steps: show them.
  if (was_run && outcome_ != Outcome::done) start(Doing::taking_up);
}

const std::vector<Section>* sections_of(const app::JobState* state) {
  if (state == nullptr || !state->results.profile || state->results.profile->sections.empty()) return nullptr;
  return &state->results.profile->sections;
}

std::optional<std::size_t> Workspace::section_index() const {
  const std::vector<Section>* sections = sections_of(state().get());
  if (sections == nullptr) return std::nullopt;
  const auto nearest = std::min_element(sections->begin(), sections->end(), [&](const Section& a, const Section& b) {
    return std::abs(a.chainage_m - cursor_m_) < std::abs(b.chainage_m - cursor_m_);
  });
  return static_cast<std::size_t>(nearest - sections->begin());
}

const Section* Workspace::section() const {
  const auto index = section_index();
  return index ? &(*sections_of(state().get()))[*index] : nullptr;
}

void Workspace::show_section(std::size_t index) {
  const std::vector<Section>* sections = sections_of(state().get());
  if (sections != nullptr && index < sections->size()) cursor_m_ = (*sections)[index].chainage_m;
}

void Workspace::show_chainage(double chainage_m) {
  cursor_m_ = chainage_m;
}

void Workspace::next_section() {
  if (const auto index = section_index()) show_section(*index + 1);
}

void Workspace::previous_section() {
  if (const auto index = section_index(); index && *index > 0) show_section(*index - 1);
}

}  // namespace adit::ui
