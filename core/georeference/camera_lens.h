#pragma once
// A camera: pinhole and distortion, in OpenCV's terms.

#include <Eigen/Core>

#include <optional>

namespace adit {

/// Camera frame: x right, y down, z ahead. Pixels: (0, 0) the centre of the first one. Distortion: radial
/// (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6), tangential p1, p2 (Brown 1966; OpenCV's rational
/// model).
struct CameraLens {
  int width = 0;
  int height = 0;
  double fx = 0.0, fy = 0.0;  ///< focal lengths [pixels]
  double cx = 0.0, cy = 0.0;  ///< principal point
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0, k4 = 0.0, k5 = 0.0, k6 = 0.0;

  double focal_sigma = 0.0005;  ///< how well the focal lengths are known, over themselves; by files that do not say it

  double focal_px() const { return 0.5 * (fx + fy); }
};

/// Throws Error, naming the number, when the lens cannot be one: no size, no focal length, a principal point outside of
/// the picture, numbers that are not finite.
void check_lens(const CameraLens& lens);

/// Where the lens bends a place of the plane z = 1 to, on that plane.
Eigen::Vector2d distorted(const CameraLens& lens, const Eigen::Vector2d& place);

/// Pixel of a point before the camera (z > 0).
Eigen::Vector2d pixel_of(const CameraLens& lens, const Eigen::Vector3d& in_camera);

/// The place on the plane z = 1 that a pixel shows, to 1e-10; nothing where the distortion turns back (far outside of
/// what the lens was calibrated for).
std::optional<Eigen::Vector2d> place_of(const CameraLens& lens, const Eigen::Vector2d& pixel);

/// d pixel / d point.
Eigen::Matrix<double, 2, 3> pixel_derivative(const CameraLens& lens, const Eigen::Vector3d& in_camera);

}  // namespace adit
