#include "ui/navigation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit::ui {
namespace {

constexpr double look_distance_m = 6.0;  // a wall of a tunnel, for shifting and walking
constexpr double steepest = 0.9998;      // sine of the steepest look up or down from inside

/// Both turns as one rotation: about the vertical, then about the axis to the right.
Eigen::Matrix3d turn(const render::Camera& camera, double about_vertical_rad, double about_right_rad) {
  const Eigen::Vector3d right = render::axes_of(camera).right;
  return (Eigen::AngleAxisd(about_vertical_rad, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(about_right_rad, right))
      .toRotationMatrix();
}

bool upside_down(const Eigen::Vector3d& up) {
  return up.z() < -1e-9;
}

}  // namespace

render::Camera turned(render::Camera camera, double right_px, double down_px, double height_px) {
  const double per_px = pi / height_px * (camera.orthographic ? 1.0 : -0.5);
  const render::CameraAxes axes = render::axes_of(camera);
  Eigen::Matrix3d rotation = turn(camera, -right_px * per_px, -down_px * per_px);
  const bool too_steep =
      upside_down(rotation * axes.up) || (!camera.orthographic && std::abs((rotation * axes.ahead).z()) > steepest);
  if (too_steep) rotation = turn(camera, -right_px * per_px, 0.0);
  camera.up = rotation * axes.up;
  const Eigen::Vector3d sight = rotation * (camera.focal_point - camera.position);
  if (camera.orthographic) {
    camera.position = camera.focal_point - sight;
  } else {
    camera.focal_point = camera.position + sight;
  }
  return camera;
}

render::Camera shifted(render::Camera camera, double right_px, double down_px, double height_px) {
  const render::CameraAxes axes = render::axes_of(camera);
  const double view_m =
      camera.orthographic ? camera.view_height_m : 2.0 * look_distance_m * std::tan(camera.view_angle_rad / 2.0);
  const Eigen::Vector3d by = (down_px * axes.up - right_px * axes.right) * (view_m / height_px);
  camera.position += by;
  camera.focal_point += by;
  return camera;
}

render::Camera nearer(render::Camera camera, double clicks) {
  if (camera.orthographic) {
    camera.view_height_m = std::clamp(camera.view_height_m * std::pow(0.85, clicks), 0.05, 1e5);
  } else {
    const Eigen::Vector3d by = render::axes_of(camera).ahead * (0.15 * look_distance_m * clicks);
    camera.position += by;
    camera.focal_point += by;
  }
  return camera;
}

}  // namespace adit::ui
