#include "io/job_targets_json.h"

#include <Eigen/SVD>
#include <algorithm>
#include <set>
#include <string>

#include "core/foundation/angle.h"
#include "core/georeference/camera_rig.h"
#include "io/existing_file.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;

constexpr double farthest_m = 5.0;  // from the scanner: beyond, it is not fixed to it

void check_near_scanner(const JsonPlace& place, const Eigen::Vector3d& position) {
  if (!(position.cwiseAbs().maxCoeff() <= farthest_m))
    place.refuse("the camera is more than 5 m from the scanner", "write metres in the scanner's own frame");
}

/// As results.json gives it after an adjustment.
void read_lever_arm_matrix(const JsonPlace& place, JobCamera& camera) {
  const auto values = place.numbers(16);
  Pose scan_from_camera;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) scan_from_camera.matrix()(r, c) = values[static_cast<std::size_t>(4 * r + c)];
  // Digits may have been cut: the nearest rotation.
  constexpr double most_off = 1e-3;
  const Eigen::Matrix3d said = scan_from_camera.linear();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(said, Eigen::ComputeFullU | Eigen::ComputeFullV);
  scan_from_camera.linear() = svd.matrixU() * svd.matrixV().transpose();
  if (!((scan_from_camera.linear() - said).norm() < most_off) || !is_rigid(scan_from_camera.matrix()))
    place.refuse("this is no rigid transform",
                 "copy the 16 numbers of \"cameras\" in results.json, by rows, the last row 0, 0, 0, 1");
  camera.position = scan_from_camera.translation();
  check_near_scanner(place, camera.position);
  camera.angles = lever_arm_angles(scan_from_camera);
}

void read_lever_arm(const JsonPlace& place, JobCamera& camera) {
  if (place.has("scan_from_camera")) {
    if (place.has("position") || place.has("yaw_pitch_roll_deg"))
      place.at("scan_from_camera").refuse("the lever arm stands here twice", "leave out position and angles, or this");
    read_lever_arm_matrix(place.at("scan_from_camera"), camera);
    return;
  }
  const auto position = place.at("position").numbers(3);
  camera.position = {position[0], position[1], position[2]};
  check_near_scanner(place.at("position"), camera.position);
  const auto turns = place.at("yaw_pitch_roll_deg").numbers(3);
  for (const double turn : turns)
    if (!(std::abs(turn) <= 360.0))
      place.at("yaw_pitch_roll_deg").refuse("an angle beyond 360 degrees", "degrees are needed");
  camera.angles = {rad_from_deg(turns[0]), rad_from_deg(turns[1]), rad_from_deg(turns[2])};
}

JobCamera read_camera_of_job(const JsonPlace& place, const fs::path& folder) {
  place.only_keys({"name", "file", "position", "yaw_pitch_roll_deg", "scan_from_camera", "sigma_m", "sigma_deg"});
  JobCamera camera;
  camera.name = place.text_or("name", "camera");
  if (camera.name.empty() || camera.name.size() > 200)
    place.at("name").refuse("a camera needs a name of 1 to 200 letters", "write one, for instance front");
  camera.file = existing_file(place.at("file"), folder);
  read_lever_arm(place, camera);
  if (place.has("sigma_m")) camera.sigma_m = place.at("sigma_m").number_between(1e-5, 1.0, "m");
  if (place.has("sigma_deg")) camera.sigma_rad = rad_from_deg(place.at("sigma_deg").number_between(1e-4, 10.0, "deg"));
  return camera;
}

void check_cameras(const JsonPlace& cameras, const Job& job) {
  for (std::size_t i = 0; i < job.cameras.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (job.cameras[i].name == job.cameras[k].name)
        cameras.refuse("two cameras are named \"" + job.cameras[i].name + "\"", "rename one");
}

void check_pictures(const JsonPlace& root, const Job& job) {
  std::set<std::string> named;
  for (const JobScan& scan : job.scans)
    for (const JobPicture& picture : scan.pictures) {
      if (job.cameras.empty())
        root.refuse("scan " + scan.name + " has pictures, and the job no \"cameras\"", "describe the camera");
      const bool known = std::any_of(job.cameras.begin(), job.cameras.end(),
                                     [&](const JobCamera& camera) { return camera.name == picture.camera; });
      if (picture.camera.empty() && job.cameras.size() > 1)
        root.refuse("picture " + picture.file + " does not say which camera took it, and the job has several",
                    "write {\"file\": ..., \"camera\": ...}");
      if (!picture.camera.empty() && !known)
        root.refuse("picture " + picture.file + " is of camera \"" + picture.camera + "\", which the job does not have",
                    "use the names in \"cameras\"");
      if (!named.insert((fs::path(picture.file).lexically_normal()).string()).second)
        root.refuse("picture " + picture.file + " is named twice: it would count as two observations",
                    "name each picture once, with the scan it was taken during");
    }
  const bool any =
      std::any_of(job.scans.begin(), job.scans.end(), [](const JobScan& s) { return !s.pictures.empty(); });
  if (any && job.landmarks.file.empty())
    root.refuse("pictures without surveyed targets", "name their table in \"landmarks\"");
}

}  // namespace

void read_job_targets(const JsonPlace& place, const fs::path& folder, Job& job) {
  if (place.is_text()) {
    job.targets = existing_file(place, folder);
    return;
  }
  place.only_keys({"file", "sphere_diameter", "quarters", "coded"});
  if (place.has("file")) job.targets = existing_file(place.at("file"), folder);
  if (place.has("sphere_diameter"))
    job.scan_targets.sphere_diameter_m = place.at("sphere_diameter").number_between(0.03, 1.0, "m");
  if (place.has("quarters")) job.scan_targets.quarters = place.at("quarters").yes_or_no();
  if (place.has("coded")) job.scan_targets.coded = place.at("coded").yes_or_no();
  if (job.targets.empty() && !job.scan_targets.any())
    place.refuse("it names neither a file nor what to look for",
                 "write \"file\", or \"sphere_diameter\": 0.145, \"quarters\": true or \"coded\": true");
}

void add_job_targets(const Job& job, nlohmann::ordered_json& root) {
  if (!job.scan_targets.any()) {
    if (!job.targets.empty()) root["targets"] = job.targets;
    return;
  }
  nlohmann::ordered_json targets;
  if (!job.targets.empty()) targets["file"] = job.targets;
  if (job.scan_targets.sphere_diameter_m > 0.0) targets["sphere_diameter"] = job.scan_targets.sphere_diameter_m;
  if (job.scan_targets.quarters) targets["quarters"] = true;
  if (job.scan_targets.coded) targets["coded"] = true;
  root["targets"] = targets;
}

std::vector<JobPicture> read_job_pictures(const JsonPlace& place, const fs::path& folder) {
  std::vector<JobPicture> pictures;
  for (const JsonPlace& one : place.items()) {
    if (one.is_text()) {
      pictures.push_back({existing_file(one, folder), {}});
      continue;
    }
    one.only_keys({"file", "camera"});
    pictures.push_back({existing_file(one.at("file"), folder), one.text_or("camera", "")});
  }
  return pictures;
}

void read_job_cameras(const JsonPlace& root, const fs::path& folder, Job& job) {
  if (root.has("cameras")) {
    for (const JsonPlace& camera : root.at("cameras").items())
      job.cameras.push_back(read_camera_of_job(camera, folder));
    check_cameras(root.at("cameras"), job);
  }
  if (root.has("landmarks")) {
    const JsonPlace place = root.at("landmarks");
    if (place.is_text()) {
      job.landmarks.file = existing_file(place, folder);
    } else {
      place.only_keys({"file", "sigma_m", "no_others"});
      job.landmarks.file = existing_file(place.at("file"), folder);
      if (place.has("sigma_m")) job.landmarks.sigma_m = place.at("sigma_m").number_between(0.0, 1.0, "m");
      if (place.has("no_others")) job.landmarks.no_others = place.at("no_others").yes_or_no();
    }
  }
  check_pictures(root, job);
}

nlohmann::ordered_json pictures_json(const std::vector<JobPicture>& pictures) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const JobPicture& picture : pictures) {
    if (picture.camera.empty())
      list.push_back(picture.file);
    else
      list.push_back({{"file", picture.file}, {"camera", picture.camera}});
  }
  return list;
}

void add_job_cameras(const Job& job, nlohmann::ordered_json& root) {
  for (const JobCamera& camera : job.cameras) {
    const auto deg = [](double rad) { return deg_from_rad(rad); };
    root["cameras"].push_back(
        {{"name", camera.name},
         {"file", camera.file},
         {"position", {camera.position.x(), camera.position.y(), camera.position.z()}},
         {"yaw_pitch_roll_deg",
          {deg(camera.angles.yaw_rad), deg(camera.angles.pitch_rad), deg(camera.angles.roll_rad)}},
         {"sigma_m", camera.sigma_m},
         {"sigma_deg", deg(camera.sigma_rad)}});
  }
  const JobLandmarks& landmarks = job.landmarks;
  if (landmarks.file.empty()) return;
  root["landmarks"] = {{"file", landmarks.file}, {"sigma_m", landmarks.sigma_m}, {"no_others", landmarks.no_others}};
}

}  // namespace adit::io
