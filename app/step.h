#pragma once
// A step of a job: what it depends on, how it runs, how an earlier run's result is taken up again.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/job_state.h"
#include "app/step_record.h"
#include "core/foundation/options.h"
#include "core/foundation/progress.h"
#include "render/gl_context.h"

namespace adit::app {

/// What steps need from their caller.
struct StepContext {
  std::function<std::unique_ptr<render::GlContext>()> make_gl_context;  ///< for the report's 3D pictures
};

struct Step {
  std::string name;     ///< "register"
  std::string message;  ///< "registering the scans"
  double share = 0.0;   ///< of the progress bar
  /// False: the job has nothing for this step (no design, say).
  bool (*wanted)(const JobState&);
  /// Text of everything the step depends on; its hash decides whether the step runs again.
  std::string (*depends_on)(const JobState&);
  /// Does the work and names the files it left; they are compared bit by bit before they are taken up.
  LeftFiles (*run)(JobState&, const StepContext&, Progress&);
  /// Takes up what run() left. Throws Error when it is not whole; the step then runs.
  void (*take_up)(JobState&, Progress&);
};

Step import_step();
Step targets_step();
Step register_step();
Step surface_step();
Step profile_step();
Step volume_step();
Step compare_step();
Step rings_step();
Step report_step();

/// All steps in order.
std::vector<Step> all_steps();

/// File that holds the numbers a step left; relative to state.out in a step's list of files.
std::filesystem::path step_file(const JobState& state, const std::string& name);

/// Present values of an options struct as text, for depends_on.
template <typename Options>
std::string options_text(const Options& options) {
  std::string text;
  for (const OptionRow& row : option_rows("", options)) text += row.name + "=" + row.value + ";";
  return text;
}

}  // namespace adit::app
