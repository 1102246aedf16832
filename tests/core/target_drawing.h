#pragma once
// Pictures of coded targets with exact truth: planes seen by a pinhole, sampled many times a pixel.

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/geometry/grey_picture.h"
#include "core/georeference/coded_pattern.h"

namespace adit::tests {

struct DrawnTarget {
  TargetCode code = 0;
  Eigen::Isometry3d camera_from_target = Eigen::Isometry3d::Identity();  ///< x right, y up on the paper; camera: v down
  double radius_m = 0.1;

  Eigen::Vector2d pixel(double focal_px, const Eigen::Vector2d& middle) const {
    const Eigen::Vector3d p = camera_from_target.translation();
    return middle + focal_px * Eigen::Vector2d(p.x() / p.z(), p.y() / p.z());
  }
};

/// A target so many pixels across, its axis tilted away from the view, turned in its plane.
inline DrawnTarget drawn_target(TargetCode code, const Eigen::Vector2d& pixel, double diameter_px, double tilt_rad,
                                double tilt_towards_rad, double turn_rad, double focal_px,
                                const Eigen::Vector2d& middle) {
  DrawnTarget target;
  target.code = code;
  const double depth = 2.0 * target.radius_m * focal_px / diameter_px;
  const Eigen::Vector2d at = (pixel - middle) / focal_px;
  target.camera_from_target.translation() = depth * Eigen::Vector3d(at.x(), at.y(), 1.0);
  const Eigen::Vector3d view = target.camera_from_target.translation().normalized();
  const Eigen::Quaterniond facing = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), view);
  const Eigen::Vector3d axis(std::cos(tilt_towards_rad), std::sin(tilt_towards_rad), 0.0);
  target.camera_from_target.linear() =
      (facing * Eigen::AngleAxisd(tilt_rad, axis) * Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(pi, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return target;
}

struct DrawingOptions {
  double focal_px = 1000.0;
  double white = 200.0;
  double black = 30.0;
  double blur_px = 0.7;
  double noise = 2.0;
  std::uint64_t seed = 1;
};

/// Targets on paper of 1.25 outer radii over a background; `background(u, v)` in grey levels.
template <typename Background>
GreyPicture draw_targets(int width, int height, const std::vector<DrawnTarget>& targets, const DrawingOptions& options,
                         const Background& background) {
  constexpr int samples = 4;
  const Eigen::Vector2d middle(0.5 * (width - 1), 0.5 * (height - 1));
  std::vector<double> light(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto at = [&](int u, int v) -> double& {
    return light[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) at(u, v) = background(u, v);
  for (const DrawnTarget& target : targets) {
    const Eigen::Vector3d normal = target.camera_from_target.linear().col(2);
    const double plane = normal.dot(target.camera_from_target.translation());
    const Eigen::Vector2d center = target.pixel(options.focal_px, middle);
    const double reach = 1.4 * options.focal_px * target.radius_m * coded_pattern::clear_radius /
                             (target.camera_from_target.translation().z() - target.radius_m * 1.3) +
                         2.0;
    for (int v = std::max(0, static_cast<int>(center.y() - reach));
         v < std::min(height, static_cast<int>(center.y() + reach)); ++v)
      for (int u = std::max(0, static_cast<int>(center.x() - reach));
           u < std::min(width, static_cast<int>(center.x() + reach)); ++u) {
        double sum = 0.0;
        for (int j = 0; j < samples; ++j)
          for (int i = 0; i < samples; ++i) {
            const Eigen::Vector3d ray((u + (i + 0.5) / samples - 0.5 - middle.x()) / options.focal_px,
                                      (v + (j + 0.5) / samples - 0.5 - middle.y()) / options.focal_px, 1.0);
            const Eigen::Vector3d on = target.camera_from_target.inverse() * (ray * (plane / normal.dot(ray)));
            const double x = on.x() / target.radius_m, y = on.y() / target.radius_m;
            if (std::hypot(x, y) > coded_pattern::clear_radius)
              sum += at(u, v);
            else
              sum += is_black_at(target.code, x, y) ? options.black : options.white;
          }
        at(u, v) = sum / (samples * samples);
      }
  }
  // Blur, rows then columns, and noise.
  const int half = std::max(1, static_cast<int>(std::ceil(3.0 * options.blur_px)));
  std::vector<double> kernel;
  double total = 0.0;
  for (int k = -half; k <= half; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (options.blur_px * options.blur_px)));
    total += kernel.back();
  }
  for (const bool rows : {true, false}) {
    const std::vector<double> before = light;
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        double sum = 0.0;
        for (int k = -half; k <= half; ++k) {
          const int i = rows ? std::clamp(u + k, 0, width - 1) : u, j = rows ? v : std::clamp(v + k, 0, height - 1);
          sum += kernel[static_cast<std::size_t>(k + half)] *
                 before[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
        }
        at(u, v) = sum / total;
      }
  }
  const Random random(options.seed, 99);
  GreyPicture picture(width, height);
  for (std::size_t i = 0; i < light.size(); ++i)
    picture.pixels[i] =
        static_cast<std::uint8_t>(std::clamp(std::lround(light[i] + options.noise * random.normal(i)), 0L, 255L));
  return picture;
}

}  // namespace adit::tests
