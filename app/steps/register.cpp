// Poses of all scans: pairs, control, one adjustment.

#include <chrono>
#include <cstdio>

#include "app/locate_pictures.h"
#include "app/placed_tiles.h"
#include "app/scan_places.h"
#include "app/site_guess.h"
#include "app/step.h"
#include "core/foundation/error.h"
#include "core/geometry/bounding_box.h"
#include "io/atomic_file.h"
#include "io/step_json.h"
#include "io/text_file.h"

namespace adit::app {
namespace {

bool wanted(const JobState& state) {
  return state.has_scans();
}

std::string depends_on(const JobState& state) {
  std::string text = "register 10|" + state.keys.at("import");
  for (const JobScan& scan : state.job.scans) {
    if (!scan.position) continue;
    for (const double value : {scan.position->x(), scan.position->y(), scan.position->z(), scan.angles.yaw_rad,
                               scan.angles.pitch_rad, scan.angles.roll_rad})
      text += "," + short_number(value);
    text += "|" + scan.name;
  }
  if (const auto targets = state.keys.find("targets"); targets != state.keys.end()) text += "|" + targets->second;
  for (const std::string* file : {&state.job.control, &state.job.targets, &state.job.alignment})
    if (!file->empty()) text += "|" + state.input_sha256.at(*file);
  return text + "|" + state.job.alignment_name + "|" + options_text(state.job.options.registration) + "|" +
         options_text(state.job.options.registration.icp);
}

ScanToPlace scan_to_place(const JobState& state, std::size_t index) {
  const auto& store = state.stores[index];
  ScanToPlace scan;
  scan.name = state.job.scans[index].name;
  scan.points = store;
  scan.scanner_at_origin = scanner_at_origin(*store);
  scan.local_from_scan_guess = local_from_scan_guess(state, index);
  return scan;
}

/// Those of the file, and those found in the scans that are other control points. Coordinates of the scans' files.
std::vector<TargetObservation> targets_of(const JobState& state) {
  std::vector<TargetObservation> targets = state.targets;
  const auto named = [&](const FoundTarget& found) {
    return std::any_of(state.targets.begin(), state.targets.end(), [&](const TargetObservation& target) {
      return target.scan == found.scan && target.id == found.id;
    });
  };
  for (const FoundTarget& found : state.results.targets.found)
    if (!found.id.empty() && !named(found)) targets.push_back({found.scan, found.id, found.position, found.sigma_m});
  return targets;
}

RegistrationContext context_of(const JobState& state) {
  RegistrationContext context;
  const ProjectOrigin& origin = state.results.import.origin;
  for (ControlPoint point : state.control) {
    point.position = origin.to_local(point.position);
    context.control.push_back(point);
  }
  context.targets = targets_of(state);
  // What a wrong focal length does to all pictures of a camera looks like a lever arm that is off.
  std::vector<double> farthest_m(state.job.cameras.size(), 0.0);
  for (const JobCamera& camera : state.job.cameras)
    context.cameras.push_back(
        {camera.name, lever_arm(camera.position, camera.angles), camera.sigma_m, camera.sigma_rad});
  for (const LocatedPicture& picture : state.results.targets.pictures) {
    if (!picture.result.located) continue;
    context.pictures.push_back(picture.sight);
    farthest_m[picture.sight.camera] = std::max(farthest_m[picture.sight.camera], picture.by_focal_length_m);
  }
  for (std::size_t i = 0; i < context.cameras.size(); ++i)
    context.cameras[i].sigma_m = std::hypot(context.cameras[i].sigma_m, farthest_m[i]);
  context.clock_s = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  for (std::size_t i = 0; i < state.stores.size(); ++i)
    for (auto& target : context.targets)
      if (target.scan == state.job.scans[i].name) target.position -= state.stores[i]->offset();
  if (state.alignment) {
    const Alignment axis = state.alignment->relative_to(origin.position);
    context.axis_direction = [axis](const Eigen::Vector3d& where) {
      const auto foot = axis.to_tunnel(where);
      const double chainage = foot ? foot->s_m : axis.from_m();
      const Eigen::Vector2d tangent = axis.horizontal().at(chainage).tangent();
      return Eigen::Vector3d(tangent.x(), tangent.y(), axis.vertical().at(chainage).grade).normalized();
    };
  }
  return context;
}

/// A target far outside its scan's points was taken in another frame or another unit.
void check_targets_in_scans(const JobState& state) {
  for (const auto& target : state.targets) {
    for (std::size_t i = 0; i < state.stores.size(); ++i) {
      if (target.scan != state.job.scans[i].name) continue;
      const io::PointStore& store = *state.stores[i];
      BoundingBox box;
      for (std::size_t tile = 0; tile < store.tile_count(); ++tile) box.extend(store.box(tile));
      const double outside = box.exteriorDistance(Eigen::Vector3d(target.position - store.offset()));
      if (outside <= 20.0 + box.diagonal().norm()) continue;
      char words[80];
      std::snprintf(words, sizeof words, " lies %.0f m outside the points of its scan ", outside);
      throw Error("target " + target.id + words + target.scan, (state.folder / state.job.targets).string(),
                  "write metres in the frame of the scan's file");
    }
  }
}

/// Two files can hold one scan in two formats: no two scans of a rock meet within a tenth of a millimetre.
Findings scans_with_the_same_points(const RegistrationResult& registration) {
  constexpr double too_good_m = 1e-4;
  Findings findings;
  for (const PairResult& pair : registration.pairs)
    if (pair.overlap > 0.9 && pair.median_m < too_good_m && pair.median_distance_m < too_good_m)
      findings.push_back({Severity::decision, "pair " + pair.source + " - " + pair.target,
                          "both hold the same points: one scan stands twice in the job",
                          "name the file of the other station"});
  return findings;
}

/// Scans that nothing ties to the site are not compared with the design, and their coordinates are the datum scan's.
void stand_in_site_or_alone(JobState& state) {
  if (state.results.registration.in_site) return;
  state.design.reset();
  state.results.import.origin = {};
}

LeftFiles run(JobState& state, const StepContext&, Progress& progress) {
  check_targets_in_scans(state);
  std::vector<ScanToPlace> scans;
  for (std::size_t i = 0; i < state.stores.size(); ++i) scans.push_back(scan_to_place(state, i));
  RegistrationResult& result = state.results.registration;
  result = register_scans(scans, context_of(state), state.job.options.registration, progress);
  result.pictures = with_adjusted(state.results.targets.pictures, result.pictures);
  stand_in_site_or_alone(state);
  for (const Finding& finding : state.results.targets.findings)
    if (finding.severity == Severity::decision) result.accepted = false;
  for (Finding& finding : scans_beside_axis(state)) {
    state.results.registration.findings.push_back(std::move(finding));
    state.results.registration.accepted = false;
  }
  for (Finding& finding : scans_with_the_same_points(state.results.registration)) {
    state.results.registration.findings.push_back(std::move(finding));
    state.results.registration.accepted = false;
  }
  io::write_file_atomically(step_file(state, "register"), io::step_text(state.results.registration));
  return {"steps/register.json"};
}

void take_up(JobState& state, Progress&) {
  io::read_step_text(io::read_text_file(step_file(state, "register")), state.results.registration);
  stand_in_site_or_alone(state);
}

}  // namespace

Step register_step() {
  return {"register", "registering the scans", 0.35, wanted, depends_on, run, take_up};
}

}  // namespace adit::app
