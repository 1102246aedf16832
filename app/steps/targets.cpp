// Targets: in the pictures of the job's cameras, and in the scans themselves.

#include <map>

#include "app/find_targets.h"
#include "app/locate_pictures.h"
#include "app/placed_tiles.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool any_pictures(const JobState& state) {
  for (const JobScan& scan : state.job.scans)
    if (!scan.pictures.empty()) return true;
  return false;
}

bool wanted(const JobState& state) {
  return state.has_scans() && (state.job.scan_targets.any() || any_pictures(state));
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += "," + short_number(value);
  return text;
}

std::string pictures_text(const JobState& state) {
  const Job& job = state.job;
  std::string text;
  for (const JobScan& scan : job.scans)
    for (const JobPicture& picture : scan.pictures)
      text += "|" + scan.name + "," + picture.file + "," + state.input_sha256.at(picture.file) + "," + picture.camera;
  for (const JobCamera& camera : job.cameras)
    text += "|" + camera.name + "," + state.input_sha256.at(camera.file) +
            numbers({camera.position.x(), camera.position.y(), camera.position.z(), camera.angles.yaw_rad,
                     camera.angles.pitch_rad, camera.angles.roll_rad, camera.sigma_m, camera.sigma_rad});
  if (!job.landmarks.file.empty()) text += "|" + state.input_sha256.at(job.landmarks.file);
  return text + numbers({job.landmarks.sigma_m, job.landmarks.no_others ? 1.0 : 0.0});
}

std::string scan_targets_text(const JobState& state) {
  const JobScanTargets& targets = state.job.scan_targets;
  if (!targets.any()) return {};
  const RegistrationOptions& options = state.job.options.registration;
  std::string text = numbers({targets.sphere_diameter_m, targets.quarters ? 1.0 : 0.0, targets.coded ? 1.0 : 0.0,
                              options.control_sigma_m, options.guess_sigma_m, options.guess_sigma_deg}) +
                     "|" + state.input_sha256.at(state.job.control);
  for (const JobScan& scan : state.job.scans)
    if (scan.position)
      text += "|" + scan.name +
              numbers({scan.position->x(), scan.position->y(), scan.position->z(), scan.angles.yaw_rad,
                       scan.angles.pitch_rad, scan.angles.roll_rad});
  return text;
}

std::string depends_on(const JobState& state) {
  return "targets 2|" + state.keys.at("import") + pictures_text(state) + scan_targets_text(state);
}

/// A lever arm is of the scanner's own frame.
void check_pictures_have_scanners(const JobState& state) {
  for (std::size_t i = 0; i < state.stores.size(); ++i)
    if (!state.job.scans[i].pictures.empty() && !scanner_at_origin(*state.stores[i]))
      throw Error("its file does not say where the scanner stood, so that its pictures say nothing of it",
                  "scan " + state.job.scans[i].name, "export the scan in the scanner's own frame");
}

/// A copy under another name would count as a second observation.
void check_pictures_differ(const JobState& state) {
  std::map<std::string, std::string> named;
  for (const JobScan& scan : state.job.scans)
    for (const JobPicture& picture : scan.pictures)
      if (const auto [first, is_new] = named.emplace(state.input_sha256.at(picture.file), picture.file); !is_new)
        throw Error("it is a copy of " + first->second, (state.folder / picture.file).string(),
                    "name each picture once, with the scan it was taken during");
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  check_pictures_differ(state);
  check_pictures_have_scanners(state);
  TargetsResult result;
  Progress in_pictures = progress.part(state.job.scan_targets.any() ? 0.2 : 1.0, "finding targets in pictures");
  result.pictures = locate_pictures(state, result.findings, in_pictures);
  Progress in_scans = progress.part(0.8, "looking for targets in the scans");
  result.looked_in_scans = state.job.scan_targets.any();
  if (result.looked_in_scans) result.found = find_targets(state, result.findings, in_scans);
  state.results.targets = std::move(result);
  io::write_file_atomically(step_file(state, "targets"), io::step_text(state.results.targets));
  return {"steps/targets.json"};
}

void take_up(JobState& state, Progress&) {
  io::read_step_text(io::read_text_file(step_file(state, "targets")), state.results.targets);
}

}  // namespace

Step targets_step() {
  return {"targets", "finding targets", 0.1, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
