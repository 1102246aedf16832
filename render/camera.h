#pragma once
// Where a scene is seen from.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/geometry/bounding_box.h"

namespace adit::render {

/// Local frame [m]. Orthographic cameras show view_height_m from the lower to the upper rim, others view_angle_rad.
struct Camera {
  Eigen::Vector3d position = Eigen::Vector3d(0.0, -10.0, 0.0);
  Eigen::Vector3d focal_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  bool orthographic = false;
  double view_height_m = 10.0;
  double view_angle_rad = 0.9;
};

/// Unit axes of a camera: to the right, up and ahead.
struct CameraAxes {
  Eigen::Vector3d right;
  Eigen::Vector3d up;
  Eigen::Vector3d ahead;
};
CameraAxes axes_of(const Camera& camera);

/// Pixel (x right, y down, from the upper left corner) of a point; empty behind the camera.
std::optional<Eigen::Vector2d> pixel_of(const Camera& camera, int width, int height, const Eigen::Vector3d& point);

/// An orthographic camera looking along `ahead` that holds all the points in a picture of width / height = aspect.
Camera fitted(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& ahead, const Eigen::Vector3d& up,
              double aspect);

/// The eight corners of a box, for the functions here.
std::vector<Eigen::Vector3d> corners(const BoundingBox& box);

/// From above, `heading` (horizontal part of it) pointing to the right of the picture.
Camera top_view(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& heading, double aspect);

/// From above and the right of the heading, 35 degrees down, turned a quarter towards the front.
Camera oblique(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& heading, double aspect);

/// Perspective, standing at `eye` and looking along `ahead`.
Camera along_tunnel(const Eigen::Vector3d& eye, const Eigen::Vector3d& ahead);

}  // namespace adit::render
