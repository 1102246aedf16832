#pragma once
// What the panels share: the open job, its runner, the last snapshot, the selection and the chainage cursor.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "app/job_runner.h"
#include "core/profiling/section.h"
#include "ui/script.h"

namespace adit::ui {

/// Panels read it and call its few actions; nothing here computes. Used by the window's thread alone.
class Workspace {
 public:
  enum class Doing { nothing, taking_up, running };

  /// context: what steps need on the job's thread. out: everything derived; empty: "out" in the job's folder.
  explicit Workspace(app::StepContext context, std::filesystem::path out = {});

  /// Opens job.json or its folder and takes up what earlier runs left; the job open before is cancelled and closed.
  void open(const std::filesystem::path& job);
  void run();
  void cancel();
  void close();

  /// Once per frame: takes the runner's snapshot.
  void poll();

  bool has_job() const { return runner_ != nullptr; }
  const std::filesystem::path& job_path() const { return job_path_; }
  Doing doing() const { return doing_; }
  bool cancelling() const { return cancelling_; }
  double fraction() const { return snapshot_.fraction; }
  const std::string& message() const { return snapshot_.message; }

  /// How the last run ended (taking up is no run), and its error or that of opening, one line.
  app::JobRunner::Outcome outcome() const { return outcome_; }
  const std::string& error() const { return error_; }

  /// The job and its results; empty until the job could be read.
  const std::shared_ptr<const app::JobState>& state() const { return snapshot_.state; }

  /// Index of the selected scan.
  std::optional<std::size_t> scan() const { return scan_; }
  void select_scan(std::optional<std::size_t> scan) { scan_ = scan; }

  /// Where the job's sections are looked at: an index into them; empty when there are none.
  std::optional<std::size_t> section_index() const;
  const Section* section() const;
  void show_section(std::size_t index);
  /// Shows the section nearest to a chainage.
  void show_chainage(double chainage_m);
  void next_section();
  void previous_section();

  Script& script() { return script_; }

 private:
  void start(Doing doing);
  void ended();

  app::StepContext context_;
  std::filesystem::path out_;
  std::filesystem::path job_path_;
  std::unique_ptr<app::JobRunner> runner_;
  app::JobRunner::Snapshot snapshot_;
  Doing doing_ = Doing::nothing;
  bool cancelling_ = false;
  app::JobRunner::Outcome outcome_ = app::JobRunner::Outcome::none;
  std::string error_;
  std::optional<std::size_t> scan_;
  double cursor_m_ = 0.0;
  Script script_;
};

/// The sections of a state; nullptr when they are not made.
const std::vector<Section>* sections_of(const app::JobState* state);

}  // namespace adit::ui
