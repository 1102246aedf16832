#include "app/demo_pictures.h"

#include <algorithm>
#include <string>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/georeference/camera_rig.h"
#include "core/simulation/rock_mesh.h"
#include "io/atomic_file.h"
#include "io/camera_file.h"
#include "io/control_csv.h"
#include "io/grey_picture_file.h"
#include "render/photograph.h"

namespace adit::app {
namespace {

namespace fs = std::filesystem;

constexpr double target_radius_m = 0.11;  // as large as A3 holds
constexpr double free_m = 0.14;           // before the rock, so that no rim of one that is turned sinks into it
constexpr double surveyed_sigma_m = 0.001;

CameraLens demo_lens() {
  CameraLens lens;
  lens.width = 1600;
  lens.height = 1200;
  lens.fx = 1255.0;
  lens.fy = 1253.0;
  lens.cx = 806.0;
  lens.cy = 595.0;
  lens.k1 = -0.11;
  lens.k2 = 0.04;
  lens.p1 = 0.0006;
  lens.p2 = -0.0004;
  return lens;
}

/// As a calibration gave it: off by its sigma.
CameraLens calibrated_lens(std::uint64_t seed) {
  CameraLens lens = demo_lens();
  lens.focal_sigma = 1e-4;
  const double scale = 1.0 + lens.focal_sigma * Random(seed, 1703).normal(0);
  lens.fx *= scale;
  lens.fy *= scale;
  return lens;
}

Pose true_lever_arm() {
  return lever_arm({0.14, -0.03, 0.19}, {rad_from_deg(1.4), rad_from_deg(-3.0), rad_from_deg(0.6)});
}

/// As somebody measured it: off by its sigmas.
JobCamera measured_camera(std::uint64_t seed) {
  const Random random(seed, 1700);
  JobCamera camera;
  camera.name = "front";
  camera.file = "camera.yaml";
  camera.sigma_m = 0.001;
  camera.sigma_rad = rad_from_deg(0.02);
  Pose pose = true_lever_arm();
  const auto noise = [&](std::uint64_t n) -> Eigen::Vector3d {
    return {random.normal(n), random.normal(n + 1), random.normal(n + 2)};
  };
  pose.translation() += camera.sigma_m * noise(0);
  pose.linear() = (rotation_from_vector(camera.sigma_rad * noise(3)) * pose.linear()).eval();
  camera.position = pose.translation();
  camera.angles = lever_arm_angles(pose);
  return camera;
}

/// On walls and roof in turn, one every 80 cm.
std::vector<render::SceneTarget> hung_targets(const DemoPictures& demo) {
  const double places[] = {-8.4, 7.6, -5.6, 5.2, -3.1, 2.6, 0.4};
  const Random random(demo.seed, 1701);
  std::vector<render::SceneTarget> targets;
  int id = 1;
  for (double s = demo.from_m; s < demo.to_m; s += 0.8, ++id) {
    const auto n = static_cast<std::uint64_t>(id);
    targets.push_back({code_of_id(id), target_radius_m,
                       place_facing_back(demo.tunnel, s, places[id % 7] + 0.4 * random.uniform(n, -1.0, 1.0), free_m)});
  }
  return targets;
}

void write_landmarks(const DemoPictures& demo, const std::vector<render::SceneTarget>& targets, const fs::path& file) {
  const Random random(demo.seed, 1702);
  std::vector<ControlPoint> surveyed;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::Vector3d noise(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
    surveyed.push_back({std::to_string(id_of_code(targets[i].code)),
                        targets[i].site_from_target.translation() + demo.origin + surveyed_sigma_m * noise});
  }
  io::write_file_atomically(file, io::control_csv_text(surveyed));
}

/// What the lamp reaches.
render::CameraScene scene_about(const DemoPictures& demo, const std::vector<render::SceneTarget>& targets,
                                const Pose& camera) {
  constexpr double behind_m = 3.0, ahead_m = 40.0, step_m = 0.08;
  const auto foot = demo.tunnel.design().alignment().to_tunnel(camera.translation());
  const double s = foot ? foot->s_m : demo.from_m;
  RockMesh rock = rock_mesh(demo.tunnel, std::max(s - behind_m, demo.tunnel.options().from_m), s + ahead_m, step_m);
  render::CameraScene scene{std::move(rock.mesh), std::move(rock.albedo), {}};
  for (const render::SceneTarget& target : targets)
    if ((target.site_from_target.translation() - camera.translation()).norm() < ahead_m)
      scene.targets.push_back(target);
  return scene;
}

}  // namespace

void write_demo_pictures(const DemoPictures& demo, const fs::path& folder, Job& job, Progress& progress) {
  constexpr double lamp_reach_m = 9.0;
  const std::vector<render::SceneTarget> targets = hung_targets(demo);
  write_landmarks(demo, targets, folder / "landmarks.csv");
  io::write_file_atomically(folder / "camera.yaml", io::camera_text(calibrated_lens(demo.seed), "adit demo"));
  job.cameras = {measured_camera(demo.seed)};
  job.landmarks = {"landmarks.csv", surveyed_sigma_m, false};
  std::error_code error;
  fs::create_directories(folder / "pictures", error);
  for (std::size_t i = 0; i < demo.stations.size(); ++i) {
    progress.step(i, demo.stations.size());
    CameraEffects effects;
    effects.seed = 1000 * demo.seed + i;
    effects.exposure = 0.9;
    effects.dust = 25;
    effects.glare = 1;
    const Pose camera = demo.stations[i] * true_lever_arm();
    const GreyPicture picture =
        render::photograph(scene_about(demo, targets, camera), demo_lens(), camera, lamp_reach_m, effects);
    const std::string name = "pictures/" + job.scans[i].name + ".png";
    io::write_file_atomically(folder / name, io::png_of(picture));
    job.scans[i].pictures = {{name, {}}};
  }
}

}  // namespace adit::app
