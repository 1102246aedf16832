#include "tests/bench/target_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/foundation/angle.h"
#include "io/atomic_file.h"
#include "io/grey_picture_file.h"
#include "render/photograph.h"
#include "tests/core/profile_shapes.h"

namespace adit::bench {

RockTunnel picture_tunnel(std::uint64_t seed) {
  Alignment axis("CL", HorizontalAlignment({{HorizontalKind::arc, "", {0, 0}, 0.4, 80, 0.004, 0.004}}, 0.0),
                 VerticalAlignment({{0, 5}, {80, 6.6}}));
  RockTunnelOptions options;
  options.seed = seed;
  options.from_m = 1.0;
  options.face_m = 60.0;
  options.clutter = false;
  const Profile profile("arch", {{{-3.0, 0.0}, {-3.0, 2.0}, 0.0},
                                 {{-3.0, 2.0}, {3.0, 2.0}, -1.0},
                                 {{3.0, 2.0}, {3.0, 0.0}, 0.0},
                                 {{3.0, 0.0}, {-3.0, 0.0}, 0.0}});
  return {DesignTunnel(std::move(axis), {{0.0, profile}}, {DesignLine{}}), options};
}

CameraLens picture_lens() {
  CameraLens lens;
  lens.width = 1152;
  lens.height = 900;
  lens.fx = 905.0;
  lens.fy = 903.0;
  lens.cx = 581.0;
  lens.cy = 446.0;
  lens.k1 = -0.11;
  lens.k2 = 0.04;
  lens.p1 = 0.0006;
  lens.p2 = -0.0004;
  return lens;
}

Pose camera_in(const RockTunnel& tunnel, double chainage_m, double aside_m, double height_m,
               const Eigen::Vector3d& turned_rad) {
  const Alignment& axis = tunnel.design().alignment();
  const PlanPoint plan = axis.horizontal().at(chainage_m);
  const Eigen::Vector3d right(plan.right().x(), plan.right().y(), 0.0),
      ahead(plan.tangent().x(), plan.tangent().y(), 0.0);
  Pose pose = Pose::Identity();
  pose.linear() << right, -Eigen::Vector3d::UnitZ(), ahead;
  pose.linear() = (pose.linear() * rotation_from_vector(turned_rad)).eval();
  pose.translation() = axis.to_site({chainage_m, aside_m, height_m});
  return pose;
}

PictureOfTargets take_picture(const render::CameraScene& scene, const CameraLens& lens, const Pose& site_from_camera,
                              double lamp_reach_m, const CameraEffects& effects) {
  PictureOfTargets taken;
  taken.picture = render::photograph(scene, lens, site_from_camera, lamp_reach_m, effects);
  const Pose camera_from_site = site_from_camera.inverse();
  for (const render::SceneTarget& target : scene.targets) {
    const Eigen::Vector3d at = camera_from_site * target.site_from_target.translation();
    if (at.z() < 0.2) continue;
    PictureOfTargets::Truth truth;
    truth.id = id_of_code(target.code);
    truth.pixel = pixel_of(lens, at);
    truth.diameter_px = 2.0 * target.radius_m * lens.focal_px() / at.z();
    const Eigen::Vector3d normal = camera_from_site.linear() * target.site_from_target.linear().col(2);
    truth.tilt_rad = std::acos(std::clamp(-normal.dot(at.normalized()), -1.0, 1.0));
    const double room = 0.5 * coded_pattern::clear_radius * truth.diameter_px + 2.0;
    if (truth.pixel.x() > room && truth.pixel.y() > room && truth.pixel.x() < lens.width - room &&
        truth.pixel.y() < lens.height - room)
      taken.targets.push_back(truth);
  }
  return taken;
}

void keep(const GreyPicture& picture, const std::string& name) {
  if (const char* folder = std::getenv("ADIT_BENCH_PICTURES"))
    io::write_file_atomically(std::string(folder) + "/" + name + ".png", io::png_of(picture));
}

DetectOptions options_of(const CameraLens& lens, int most_id) {
  DetectOptions options;
  options.fit.focal_length_px = lens.focal_px();
  for (int id = 1; id <= most_id && most_id < target_code_count; ++id) options.fit.codes.push_back(code_of_id(id));
  return options;
}

}  // namespace adit::bench
