#pragma once
// One function runs a job: for the command line, for the window and for the tests.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/job_state.h"
#include "app/step.h"
#include "core/foundation/progress.h"

namespace adit::app {

struct RunOptions {
  std::filesystem::path out;       ///< everything derived; empty: "out" in the job's folder
  std::string last_step;           ///< the last to run; later ones are taken up if they still hold; empty: all
  bool only_take_up = false;       ///< run nothing: take up what earlier runs left, as far as it is up to date
  std::uint64_t memory_bytes = 0;  ///< budget for points on their way; 0: half of the machine's memory
  StepContext context;
};

/// Runs the steps whose inputs or settings have changed and takes up the others; writes results.json and the tables.
/// A step is done when its key file names the hash of all it depends on. Throws Error (bad input, disk full, another
/// run in the same folder), Cancelled; finished steps stay finished.
std::shared_ptr<JobState> run_job(const std::filesystem::path& job_file, const RunOptions& options, Progress& progress);

/// Fractions of a run's progress between which each step of all_steps() runs: begins, and the end of the last. A step
/// that is not wanted ends where it begins.
std::vector<double> step_bounds(const JobState& state);

}  // namespace adit::app
