#include "app/step.h"

namespace adit::app {

std::vector<Step> all_steps() {
  return {import_step(), targets_step(), register_step(), surface_step(), profile_step(),
          volume_step(), compare_step(), rings_step(),    report_step()};
}

std::filesystem::path step_file(const JobState& state, const std::string& name) {
  return state.out / "steps" / (name + ".json");
}

}  // namespace adit::app
