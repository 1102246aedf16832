#include "app/locate_pictures.h"

#include "app/landmarks.h"
#include "core/foundation/error.h"
#include "core/georeference/camera_pose.h"
#include "core/georeference/detect_targets.h"
#include "io/grey_picture_file.h"

namespace adit::app {
namespace {

std::size_t camera_of(const JobState& state, const JobPicture& picture) {
  const auto& cameras = state.job.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (cameras[i].name == picture.camera) return i;
  return 0;  // the only one: io::read_job sees to that
}

DetectOptions detect_options(const JobState& state, const CameraLens& lens) {
  DetectOptions options;
  options.fit.focal_length_px = lens.focal_px();
  // Unless told otherwise every code may be read: a target that nobody surveyed must not be taken for one of these.
  if (state.job.landmarks.no_others)
    for (const auto& [id, place] : state.landmarks) options.fit.codes.push_back(code_of_id(id));
  return options;
}

void take_pose(LocatedPicture& located, const CameraPose& pose, std::size_t camera) {
  // The focal length is wrong in all pictures of a camera alike: it counts with the lever arm (context of register).
  located.sight = {located.result.scan, located.result.picture, camera, pose.site_from_camera,
                   pose.covariance - pose.by_focal_length * pose.by_focal_length.transpose()};
  located.by_focal_length_m = pose.by_focal_length.head<3>().norm();
  located.result.located = true;
  located.result.rms_px = pose.rms_px;
  for (const LandmarkResidual& landmark : pose.landmarks)
    (landmark.used ? located.result.targets : located.result.rejected).push_back(landmark.id);
}

LocatedPicture locate_picture(const JobState& state, const JobScan& scan, const JobPicture& picture, Findings& findings,
                              Progress& progress) {
  const std::size_t camera = camera_of(state, picture);
  const CameraLens& lens = state.lenses[camera];
  LocatedPicture located;
  located.result.scan = scan.name;
  located.result.picture = picture.file;
  located.result.camera = state.job.cameras[camera].name;
  const GreyPicture grey = io::read_grey_picture(state.folder / picture.file, lens);
  std::vector<LandmarkSight> sights;
  std::vector<int> unknown;
  for (const DetectedTarget& target : detect_targets(grey, detect_options(state, lens), progress)) {
    const auto surveyed = state.landmarks.find(target.id);
    if (surveyed == state.landmarks.end())
      unknown.push_back(target.id);
    else
      sights.push_back({std::to_string(target.id), state.results.import.origin.to_local(surveyed->second),
                        target.center, target.sigma_px});
  }
  for (const int id : unknown) located.result.unknown.push_back(std::to_string(id));
  CameraPoseOptions options;
  options.landmark_sigma_m = state.job.landmarks.sigma_m;
  try {
    const CameraPose pose = locate_by_landmarks(lens, sights, unknown, options);
    take_pose(located, pose, camera);
    for (Finding finding : pose.findings) {
      finding.subject = "picture " + picture.file + ", " + finding.subject;
      findings.push_back(std::move(finding));
    }
  } catch (const Error& error) {
    findings.push_back(
        {Severity::decision, "picture " + picture.file, "not used: " + error.what_is_wrong(), error.mend()});
  }
  return located;
}

}  // namespace

std::vector<LocatedPicture> locate_pictures(const JobState& state, Findings& findings, Progress& progress) {
  std::size_t count = 0;
  for (const JobScan& scan : state.job.scans) count += scan.pictures.size();
  std::vector<LocatedPicture> located;
  for (const JobScan& scan : state.job.scans)
    for (const JobPicture& picture : scan.pictures) {
      progress.step(located.size(), count);
      located.push_back(locate_picture(state, scan, picture, findings, progress));
    }
  return located;
}

std::vector<PictureResult> with_adjusted(std::vector<LocatedPicture> located,
                                         const std::vector<PictureResult>& adjusted) {
  std::vector<PictureResult> all;
  std::size_t next = 0;
  for (LocatedPicture& one : located) {
    all.push_back(std::move(one.result));
    if (!all.back().located || next == adjusted.size()) continue;
    PictureResult merged = adjusted[next++];
    merged.targets = std::move(all.back().targets);
    merged.rejected = std::move(all.back().rejected);
    merged.unknown = std::move(all.back().unknown);
    merged.rms_px = all.back().rms_px;
    all.back() = std::move(merged);
  }
  return all;
}

}  // namespace adit::app
