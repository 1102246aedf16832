// adit target detect, locate, calibrate: what pictures of targets say.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/command_line/target.h"
#include "app/landmarks.h"
#include "core/foundation/angle.h"
#include "core/georeference/calibrate_camera.h"
#include "core/georeference/camera_pose.h"
#include "core/georeference/detect_targets.h"
#include "io/atomic_file.h"
#include "io/camera_file.h"
#include "io/csv_rows.h"
#include "io/grey_picture_file.h"
#include "io/text_place.h"

namespace adit::app {
namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> images;
  std::string ids;
  std::string camera;
  std::string database;
  std::string board;
  std::string out;
  CameraPoseOptions pose;
};

DetectOptions detect_options(const std::string& ids, double focal_px) {
  DetectOptions options;
  options.fit.focal_length_px = focal_px;
  if (!ids.empty())
    for (const int id : ids_of(ids)) options.fit.codes.push_back(code_of_id(id));
  return options;
}

/// Calls visit(image) for each; goes on after those that cannot be read and throws them all at the end.
template <typename Visit>
void for_each_image(const std::vector<std::string>& images, Progress& progress, const Visit& visit) {
  BadFiles bad;
  for (std::size_t i = 0; i < images.size(); ++i) {
    progress.step(i, images.size());
    try {
      with_place(images[i], [&] { visit(images[i]); });
    } catch (const Error& error) {
      bad.errors.push_back(error);
    }
  }
  if (!bad.errors.empty()) throw bad;
}

double micro(double value) {
  return std::round(value * 1e6) / 1e6;
}

json target_json(const DetectedTarget& target) {
  return {{"id", target.id},
          {"u", micro(target.center.x())},
          {"v", micro(target.center.y())},
          {"diameter_px", micro(target.diameter_px)},
          {"sigma_px", micro(target.sigma_px)}};
}

int detect(const Arguments& arguments, const CommonOptions& common, Progress& progress) {
  std::optional<CameraLens> lens;
  if (!arguments.camera.empty()) lens = io::read_camera(arguments.camera);
  const DetectOptions options = detect_options(arguments.ids, lens ? lens->focal_px() : 0.0);
  json list = json::array();
  const auto finish = [&] {
    if (common.json) std::printf("%s\n", list.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
  };
  try {
    for_each_image(arguments.images, progress, [&](const std::string& image) {
      const std::vector<DetectedTarget> targets = detect_targets(io::read_grey_picture(image, lens), options, progress);
      if (!common.json && list.empty()) std::printf("image,id,u,v,diameter_px,sigma_px\n");
      if (targets.empty() && !common.quiet) std::fprintf(stderr, "adit: %s: no target is found in it\n", image.c_str());
      json one{{"image", image}, {"targets", json::array()}};
      for (const DetectedTarget& target : targets) {
        one["targets"].push_back(target_json(target));
        if (!common.json)
          std::printf("%s,%d,%.4f,%.4f,%.2f,%.4f\n", io::csv_word(image).c_str(), target.id, target.center.x(),
                      target.center.y(), target.diameter_px, target.sigma_px);
      }
      list.push_back(std::move(one));
    });
  } catch (const BadFiles&) {
    finish();
    throw;
  }
  finish();
  return exit_good;
}

json pose_json(const std::string& image, const CameraPose& pose, const std::vector<int>& unknown) {
  json one{{"image", image}, {"pose", json::array()}};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) one["pose"].push_back(pose.site_from_camera.matrix()(r, c));
  const auto sigma = [&](int i, double unit) { return unit * std::sqrt(std::max(0.0, pose.covariance(i, i))); };
  one["sigma_mm"] = {{"east", sigma(0, 1e3)}, {"north", sigma(1, 1e3)}, {"up", sigma(2, 1e3)}};
  one["sigma_mdeg"] = {{"about_east", sigma(3, 1e3 * deg_from_rad(1.0))},
                       {"about_north", sigma(4, 1e3 * deg_from_rad(1.0))},
                       {"about_up", sigma(5, 1e3 * deg_from_rad(1.0))}};
  one["rms_px"] = pose.rms_px;
  one["used"] = json::array();
  one["rejected"] = json::array();
  for (const LandmarkResidual& landmark : pose.landmarks) {
    json residual{{"id", std::stoi(landmark.id)},
                  {"residual_px", {landmark.residual_px.x(), landmark.residual_px.y()}}};
    one[landmark.used ? "used" : "rejected"].push_back(std::stoi(landmark.id));
    residual[landmark.used ? "normalised" : "beside_m"] = landmark.used ? landmark.normalised : landmark.across_m;
    one["targets"].push_back(residual);
  }
  one["not_in_database"] = unknown;
  one["posit"] = {{"rms_px", pose.posit.rms_px}, {"iterations", pose.posit.iterations}, {"pose", json::array()}};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) one["posit"]["pose"].push_back(pose.posit.site_from_camera.matrix()(r, c));
  one["findings"] = json::array();
  for (const Finding& finding : pose.findings)
    one["findings"].push_back({{"severity", finding.severity == Severity::decision ? "decision" : "warning"},
                               {"subject", finding.subject},
                               {"words", finding.words},
                               {"mend", finding.mend}});
  return one;
}

void print_pose(const std::string& image, const CameraPose& pose) {
  const Eigen::Vector3d p = pose.site_from_camera.translation();
  const auto sigma = [&](int i, double unit) { return unit * std::sqrt(std::max(0.0, pose.covariance(i, i))); };
  std::printf(
      "%s: east %.4f north %.4f elevation %.4f, sigma %.1f / %.1f / %.1f mm, turned %.1f / %.1f / %.1f mdeg, %zu targets, rms %.2f px\n",
      image.c_str(), p.x(), p.y(), p.z(), sigma(0, 1e3), sigma(1, 1e3), sigma(2, 1e3),
      sigma(3, 1e3 * deg_from_rad(1.0)), sigma(4, 1e3 * deg_from_rad(1.0)), sigma(5, 1e3 * deg_from_rad(1.0)),
      pose.used(), pose.rms_px);
}

int locate(const Arguments& arguments, const CommonOptions& common, Progress& progress) {
  const std::optional<CameraLens> lens = io::read_camera(arguments.camera);
  const Landmarks database = read_landmarks(arguments.database);
  // Every code may be read: a target that is not in the database must not be taken for one that is.
  const DetectOptions options = detect_options(arguments.ids, lens->focal_px());
  json list = json::array();
  bool needs_a_person = false;
  const auto finish = [&] {
    if (common.json) std::printf("%s\n", list.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
  };
  try {
    for_each_image(arguments.images, progress, [&](const std::string& image) {
      list.push_back({{"image", image}, {"pose", nullptr}});  // until it is known
      std::vector<LandmarkSight> sights;
      std::vector<int> unknown;
      for (const DetectedTarget& target : detect_targets(io::read_grey_picture(image, lens), options, progress)) {
        const auto found = database.find(target.id);
        if (found == database.end())
          unknown.push_back(target.id);
        else
          sights.push_back({std::to_string(target.id), found->second, target.center, target.sigma_px});
      }
      const CameraPose pose = locate_by_landmarks(*lens, sights, unknown, arguments.pose);
      list.back() = pose_json(image, pose, unknown);
      if (!common.json) print_pose(image, pose);
      for (const Finding& finding : pose.findings) {
        needs_a_person = needs_a_person || finding.severity == Severity::decision;
        if (!common.quiet)
          std::fprintf(stderr, "adit: %s: %s: %s; %s\n", image.c_str(), finding.subject.c_str(), finding.words.c_str(),
                       finding.mend.c_str());
      }
    });
  } catch (const BadFiles&) {
    finish();
    throw;
  }
  finish();
  return needs_a_person ? exit_needs_a_person : exit_good;
}

int calibrate(const Arguments& arguments, const CommonOptions& common, Progress& progress) {
  std::error_code ignored;
  for (const std::string& in : arguments.images)
    if (std::filesystem::equivalent(in, arguments.out, ignored))
      throw Error("this is one of the pictures", arguments.out, "choose another name for --out");
  if (std::filesystem::equivalent(arguments.board, arguments.out, ignored))
    throw Error("this is the board's table", arguments.out, "choose another name for --out");
  const Landmarks board = read_landmarks(arguments.board);
  DetectOptions options;
  for (const auto& [id, place] : board) options.fit.codes.push_back(code_of_id(id));
  std::vector<BoardPicture> pictures;
  int width = 0, height = 0;
  for_each_image(arguments.images, progress, [&](const std::string& image) {
    const GreyPicture picture = io::read_grey_picture(image);
    if (width == 0) {
      width = picture.width;
      height = picture.height;
    }
    if (picture.width != width || picture.height != height)
      throw Error("the picture has another size than the first one", image, "calibrate with pictures of one size");
    BoardPicture one{image, {}};
    for (const DetectedTarget& target : detect_targets(picture, options, progress))
      one.sights.push_back({board.at(target.id), target.center, target.id, target.sigma_px});
    pictures.push_back(std::move(one));
  });
  const CameraCalibration calibration =
      with_place(arguments.board, [&] { return calibrate_camera(pictures, width, height); });
  char note[120];
  std::snprintf(note, sizeof note, "adit target calibrate: %zu pictures, rms %.3f pixels", calibration.pictures.size(),
                calibration.rms_px);
  io::write_file_atomically(arguments.out, io::camera_text(calibration.lens, note));
  bool doubtful = false;
  for (const Finding& finding : calibration.findings) {
    doubtful = doubtful || finding.severity == Severity::decision;
    if (!common.quiet)
      std::fprintf(stderr, "adit: %s: %s; %s\n", finding.subject.c_str(), finding.words.c_str(), finding.mend.c_str());
  }
  const CameraLens& lens = calibration.lens;
  if (common.json) {
    json about{{"camera", arguments.out},
               {"rms_px", calibration.rms_px},
               {"fx", lens.fx},
               {"fy", lens.fy},
               {"cx", lens.cx},
               {"cy", lens.cy},
               {"sigma_fx", calibration.sigma_fx},
               {"sigma_fy", calibration.sigma_fy},
               {"sigma_cx", calibration.sigma_cx},
               {"sigma_cy", calibration.sigma_cy},
               {"pictures", json::array()}};
    for (const auto& picture : calibration.pictures)
      about["pictures"].push_back({{"image", picture.name},
                                   {"rms_px", picture.rms_px},
                                   {"targets", picture.targets},
                                   {"tilt_deg", deg_from_rad(picture.tilt_rad)}});
    std::printf("%s\n", about.dump(-1, ' ', false, json::error_handler_t::replace).c_str());
  } else if (!common.quiet) {
    std::printf(
        "%s: focal lengths %.2f +- %.2f and %.2f +- %.2f pixels, principal point %.2f +- %.2f, %.2f +- %.2f; %zu pictures, rms %.3f pixels (+- is two sigma)\n",
        arguments.out.c_str(), lens.fx, 2.0 * calibration.sigma_fx, lens.fy, 2.0 * calibration.sigma_fy, lens.cx,
        2.0 * calibration.sigma_cx, lens.cy, 2.0 * calibration.sigma_cy, calibration.pictures.size(),
        calibration.rms_px);
  }
  return doubtful ? exit_needs_a_person : exit_good;
}

}  // namespace

Action declare_target_detect(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("IMAGE", arguments->images, "pictures: PNG, JPEG, TIFF, BMP, PGM")->required()->check(some_name);
  command
      .add_option("--ids", arguments->ids,
                  "the ids that hang there: then partly hidden ones are read, too, and no others are taken")
      ->check(some_name);
  command.add_option("--camera", arguments->camera, "the camera's calibration (OpenCV's YAML)")->check(some_name);
  return [arguments](const CommonOptions& common, Progress& progress) { return detect(*arguments, common, progress); };
}

Action declare_target_locate(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("IMAGE", arguments->images, "pictures of one camera")->required()->check(some_name);
  command.add_option("--camera", arguments->camera, "the camera's calibration (OpenCV's YAML)")
      ->required()
      ->check(some_name);
  command.add_option("--database", arguments->database, "surveyed targets: id,east,north,elevation")
      ->required()
      ->check(some_name);
  command.add_option("--ids", arguments->ids, "all ids that hang there, in the database or not")->check(some_name);
  command.add_option("--landmark-sigma", arguments->pose.landmark_sigma_m, "of each surveyed coordinate [m] (0.003)")
      ->check(number_between(0.0, 1.0));
  return [arguments](const CommonOptions& common, Progress& progress) { return locate(*arguments, common, progress); };
}

Action declare_target_calibrate(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  command.add_option("IMAGE", arguments->images, "pictures of the board, of one size")->required()->check(some_name);
  command.add_option("--board", arguments->board, "where the board's targets are: id,east,north,elevation [m]")
      ->required()
      ->check(some_name);
  command.add_option("--out", arguments->out, "the camera file to write (OpenCV's YAML)")->required()->check(some_name);
  return
      [arguments](const CommonOptions& common, Progress& progress) { return calibrate(*arguments, common, progress); };
}

}  // namespace adit::app
