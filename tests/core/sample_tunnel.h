#pragma once
// Small designs and simulated tunnels that several tests share.

#include <memory>

#include "core/foundation/angle.h"
#include "core/registration/registration.h"
#include "core/simulation/scanner.h"
#include "core/simulation/truth.h"

namespace adit::tests {

/// A straight or an arc (radius to the right, 0: straight) of 120 m from chainage 0, level, beginning at `start`.
inline Alignment sample_axis(double radius_m = 0.0, const Eigen::Vector3d& start = Eigen::Vector3d::Zero()) {
  HorizontalElement element;
  element.kind = radius_m == 0.0 ? HorizontalKind::line : HorizontalKind::arc;
  element.start = start.head<2>();
  element.azimuth_rad = rad_from_deg(30.0);
  element.length_m = 120.0;
  if (radius_m != 0.0) element.start_curvature_per_m = element.end_curvature_per_m = 1.0 / radius_m;
  VerticalPoint begin, end;
  begin.elevation_m = start.z();
  end.chainage_m = 120.0;
  end.elevation_m = start.z();
  return {"sample", HorizontalAlignment({element}, 0.0), VerticalAlignment({begin, end})};
}

inline Profile circle_profile(double radius_m = 4.0) {
  return {"circle", {{{-radius_m, 0.0}, {radius_m, 0.0}, -1.0}, {{radius_m, 0.0}, {-radius_m, 0.0}, -1.0}}};
}

/// Walls of 2 m under a half circle of 4 m radius.
inline Profile arch_profile() {
  return {"arch",
          {{{-4.0, 0.0}, {-4.0, 2.0}, 0.0},
           {{-4.0, 2.0}, {4.0, 2.0}, -1.0},
           {{4.0, 2.0}, {4.0, 0.0}, 0.0},
           {{4.0, 0.0}, {-4.0, 0.0}, 0.0}}};
}

inline DesignTunnel sample_design(const Profile& profile, double radius_m = 0.0,
                                  const Eigen::Vector3d& start = Eigen::Vector3d::Zero()) {
  return {sample_axis(radius_m, start), {{0.0, profile}}, {{"excavation", 0.0}, {"pay", 0.2}}};
}

/// Rock between chainage 1 and a face at 80.
inline RockTunnel sample_rock(double radius_m = 150.0, bool clutter = false) {
  RockTunnelOptions options;
  options.seed = 5;
  options.from_m = 1.0;
  options.face_m = 80.0;
  options.clutter = clutter;
  return {sample_design(arch_profile(), radius_m), options};
}

/// Standing pose on the axis, level, turned about the vertical.
inline Pose station(const DesignTunnel& design, double chainage_m, double yaw_deg) {
  return make_pose(design.alignment().to_site({chainage_m, 0.3, 1.6}), {rad_from_deg(yaw_deg), 0.0, 0.0});
}

inline PointCloud scan_at(const RockTunnel& rock, const Pose& pose, std::uint64_t seed, std::uint64_t pulses = 120000) {
  ScannerOptions options;
  options.seed = seed;
  options.pulses = pulses;
  Progress progress;
  return scan_tunnel(rock, pose, options, {}, progress);
}

inline ScanToPlace scan_to_place(const std::string& name, PointCloud cloud, const Pose& guess) {
  ScanToPlace scan;
  scan.name = name;
  scan.points = std::make_shared<CloudTiles>(std::move(cloud));
  scan.local_from_scan_guess = guess;
  return scan;
}

/// Nothing known but the axis of the tunnel, frame: local.
inline RegistrationContext context_along(const Alignment& axis) {
  RegistrationContext context;
  context.axis_direction = [axis](const Eigen::Vector3d& where) {
    const auto at = axis.to_tunnel(where);
    const double s_m = at ? at->s_m : axis.from_m();
    const Eigen::Vector2d t = axis.horizontal().at(s_m).tangent();
    return Eigen::Vector3d(t.x(), t.y(), axis.vertical().at(s_m).grade).normalized();
  };
  return context;
}

/// The pose moved by shift and turned about the vertical.
inline Pose off(Pose pose, const Eigen::Vector3d& shift_m, double yaw_deg) {
  pose.translation() += shift_m;
  pose.linear() = Eigen::AngleAxisd(rad_from_deg(yaw_deg), Eigen::Vector3d::UnitZ()).toRotationMatrix() * pose.linear();
  return pose;
}

}  // namespace adit::tests
