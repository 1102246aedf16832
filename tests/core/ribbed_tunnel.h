#pragma once
// A tunnel with ribs: every period it looks the same, but for its roughness.

#include <Eigen/Core>

#include <cmath>
#include <vector>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/foundation/random.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/pose.h"

namespace adit::tests {

/// Axis along x through the origin, or an arc that leaves it to the left; radius 4 m, floor 2.5 m below.
struct RibbedTunnel {
  double rib_m = 0.15;       ///< how far ribs stand out
  double width_m = 0.2;      ///< of a rib
  double period_m = 1.1;     ///< from rib to rib
  double roughness_m = 0.0;  ///< one sigma, in lumps of half a metre
  double bend_per_m = 0.0;   ///< curvature of the axis
  double face_m = 1e9;       ///< where it ends
  double machine_m = 1e9;    ///< the middle of a block of 3 x 2 x 2 m that stands on the floor, to the left
  Random random{77};

  double lumps(double u, double v) const {
    const double x = 2.0 * u, y = 2.0 * v;
    const double i = std::floor(x), j = std::floor(y);
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const auto height = [&](double a, double b) {
      return random.normal(static_cast<std::uint64_t>((a + 5000.0) * 10007.0 + b + 5000.0));
    };
    const double a = smooth(x - i), b = smooth(y - j);
    return (1 - b) * ((1 - a) * height(i, j) + a * height(i + 1, j)) +
           b * ((1 - a) * height(i, j + 1) + a * height(i + 1, j + 1));
  }

  /// Along the axis, to the left and up.
  Eigen::Vector3d straightened(const Eigen::Vector3d& p) const {
    if (bend_per_m == 0.0) return p;
    const double radius_m = 1.0 / bend_per_m;
    return {radius_m * std::atan2(p.x(), radius_m - p.y()), radius_m - std::hypot(p.x(), radius_m - p.y()), p.z()};
  }

  /// A pose of the straight tunnel, as far along the bent one.
  Pose bent(const Pose& pose) const {
    if (bend_per_m == 0.0) return pose;
    const double turn = pose.translation().x() * bend_per_m;
    const Eigen::Matrix3d rotation = rotation_from_vector({0.0, 0.0, turn});
    const Eigen::Vector3d on_axis(std::sin(turn) / bend_per_m, (1.0 - std::cos(turn)) / bend_per_m, 0.0);
    const Eigen::Vector3d beside(0.0, pose.translation().y(), pose.translation().z());
    Pose result = pose;
    result.linear() = rotation * pose.linear();
    result.translation() = on_axis + rotation * beside;
    return result;
  }

  bool is_rock(const Eigen::Vector3d& place) const {
    const Eigen::Vector3d p = straightened(place);
    const double in_period = p.x() - period_m * std::floor(p.x() / period_m);
    const double radius = in_period < width_m ? 4.0 - rib_m : 4.0;
    const double rough = roughness_m > 0.0 ? roughness_m * lumps(p.x(), 4.0 * std::atan2(p.z(), p.y())) : 0.0;
    const bool machine = std::abs(p.x() - machine_m) < 1.5 && p.y() > 0.5 && p.y() < 2.5 && p.z() < -0.5;
    return machine || p.x() > face_m || p.z() < -2.5 || std::hypot(p.y(), p.z()) > radius + rough;
  }

  /// Pulses evenly over the sphere, ranges to 20 m with 3 mm noise; scan frame.
  PointCloud scan(const Pose& tunnel_from_scan, std::size_t pulses, std::uint64_t seed) const {
    constexpr double step_m = 0.05, most_m = 20.0;
    const Random pulse(seed);
    std::vector<Eigen::Vector3f> hit(pulses, Eigen::Vector3f::Zero());
    parallel_for_each_index(
        pulses,
        [&](std::size_t i) {
          const double z = pulse.uniform(4 * i, -1.0, 1.0), turn = pulse.uniform(4 * i + 1, -pi, pi);
          const double flat = std::sqrt(1.0 - z * z);
          const Eigen::Vector3d towards(flat * std::cos(turn), flat * std::sin(turn), z);
          const auto at = [&](double range) { return tunnel_from_scan * Eigen::Vector3d(range * towards); };
          double far = 0.5;
          while (far < most_m && !is_rock(at(far))) far += step_m;
          if (far >= most_m) return;
          double near = far - step_m;
          for (int k = 0; k < 12; ++k) {
            const double middle = 0.5 * (near + far);
            (is_rock(at(middle)) ? far : near) = middle;
          }
          hit[i] = ((far + 0.003 * pulse.normal(4 * i + 2)) * towards).cast<float>();
        },
        256);
    PointCloud cloud;
    for (const Eigen::Vector3f& point : hit)
      if (!point.isZero()) cloud.points.push_back(point);
    return cloud;
  }
};

}  // namespace adit::tests
