// Rings measured by total station against the axis.

#include "app/step.h"
#include "io/atomic_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool wanted(const JobState& state) {
  return state.job.rings.has_value();
}

std::string depends_on(const JobState& state) {
  const JobRings& rings = *state.job.rings;
  std::string text = "rings 4|" + state.input_sha256.at(rings.file) + "|" + state.input_sha256.at(state.job.alignment) +
                     "|" + state.job.alignment_name;
  for (const double number :
       {state.job.alignment_start_m.value_or(0.0), rings.target_offset_m, rings.design.center_offset_m,
        rings.design.center_height_m, rings.design.radius_m, rings.design.tolerance_m})
    text += "|" + short_number(number);
  return text;
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  state.results.rings = fit_rings(state.ring_points, *state.alignment, state.job.rings->design, progress);
  io::write_file_atomically(step_file(state, "rings"), io::step_text(*state.results.rings));
  return {"steps/rings.json"};
}

void take_up(JobState& state, Progress&) {
  RingsResult result;
  io::read_step_text(io::read_text_file(step_file(state, "rings")), result);
  state.results.rings = std::move(result);
}

}  // namespace

Step rings_step() {
  return {"rings", "fitting the rings", 0.02, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
