#include "core/georeference/camera_lens.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

/// d distorted / d place.
Eigen::Matrix2d distortion_derivative(const CameraLens& lens, const Eigen::Vector2d& place) {
  const double x = place.x(), y = place.y(), r2 = place.squaredNorm();
  const double up = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double down = 1.0 + r2 * (lens.k4 + r2 * (lens.k5 + r2 * lens.k6));
  const double up_rate = lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3);
  const double down_rate = lens.k4 + r2 * (2.0 * lens.k5 + r2 * 3.0 * lens.k6);
  const double radial = up / down, rate = (up_rate * down - up * down_rate) / (down * down);  // d radial / d r2
  Eigen::Matrix2d d;
  d << radial + 2.0 * x * x * rate + 2.0 * lens.p1 * y + 6.0 * lens.p2 * x,
      2.0 * x * y * rate + 2.0 * lens.p1 * x + 2.0 * lens.p2 * y,
      2.0 * x * y * rate + 2.0 * lens.p1 * x + 2.0 * lens.p2 * y,
      radial + 2.0 * y * y * rate + 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
  return d;
}

}  // namespace

void check_lens(const CameraLens& lens) {
  for (const double number :
       {lens.fx, lens.fy, lens.cx, lens.cy, lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6})
    if (!std::isfinite(number)) throw Error("a number of the camera is not finite", {}, "calibrate it again");
  if (lens.width < 16 || lens.height < 16 || lens.width > 100000 || lens.height > 100000)
    throw Error(
        "the camera's picture is " + std::to_string(lens.width) + " x " + std::to_string(lens.height) + " pixels", {},
        "state image_width and image_height");
  const double longer = std::max(lens.width, lens.height);
  if (!(lens.fx > 0.05 * longer && lens.fx < 100.0 * longer && lens.fy > 0.05 * longer && lens.fy < 100.0 * longer))
    throw Error("focal lengths of " + short_number(lens.fx) + " and " + short_number(lens.fy) +
                    " pixels for a picture of " + std::to_string(lens.width) + " x " + std::to_string(lens.height),
                {}, "the camera matrix counts in pixels of the same picture size");
  if (!(lens.cx > 0.0 && lens.cx < lens.width && lens.cy > 0.0 && lens.cy < lens.height))
    throw Error(
        "the principal point " + short_number(lens.cx) + ", " + short_number(lens.cy) + " lies outside the picture", {},
        "the camera matrix counts in pixels of the same picture size");
}

Eigen::Vector2d distorted(const CameraLens& lens, const Eigen::Vector2d& place) {
  const double x = place.x(), y = place.y(), r2 = place.squaredNorm();
  const double radial =
      (1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3))) / (1.0 + r2 * (lens.k4 + r2 * (lens.k5 + r2 * lens.k6)));
  return {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
          y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y};
}

Eigen::Vector2d pixel_of(const CameraLens& lens, const Eigen::Vector3d& in_camera) {
  const Eigen::Vector2d bent = distorted(lens, in_camera.head<2>() / in_camera.z());
  return {lens.cx + lens.fx * bent.x(), lens.cy + lens.fy * bent.y()};
}

std::optional<Eigen::Vector2d> place_of(const CameraLens& lens, const Eigen::Vector2d& pixel) {
  constexpr int most_steps = 30;
  constexpr double exact = 1e-11;
  const Eigen::Vector2d wanted((pixel.x() - lens.cx) / lens.fx, (pixel.y() - lens.cy) / lens.fy);
  Eigen::Vector2d place = wanted;
  for (int i = 0; i < most_steps; ++i) {
    const Eigen::Vector2d off = distorted(lens, place) - wanted;
    const Eigen::Matrix2d derivative = distortion_derivative(lens, place);
    if (!off.allFinite() || derivative.determinant() < 0.05) return std::nullopt;
    if (off.norm() < exact) return place;
    place -= derivative.inverse() * off;
  }
  return std::nullopt;
}

Eigen::Matrix<double, 2, 3> pixel_derivative(const CameraLens& lens, const Eigen::Vector3d& in_camera) {
  const double z = in_camera.z();
  Eigen::Matrix<double, 2, 3> plane;
  plane << 1.0 / z, 0.0, -in_camera.x() / (z * z), 0.0, 1.0 / z, -in_camera.y() / (z * z);
  Eigen::Matrix<double, 2, 3> d = distortion_derivative(lens, in_camera.head<2>() / z) * plane;
  d.row(0) *= lens.fx;
  d.row(1) *= lens.fy;
  return d;
}

}  // namespace adit
