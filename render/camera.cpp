#include "render/camera.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit::render {
namespace {

constexpr double margin = 1.08;  // of the picture around the points

Eigen::Vector3d level(const Eigen::Vector3d& direction) {
  const Eigen::Vector3d flat(direction.x(), direction.y(), 0.0);
  return flat.norm() > 1e-9 ? Eigen::Vector3d(flat.normalized()) : Eigen::Vector3d::UnitX();
}

}  // namespace

CameraAxes axes_of(const Camera& camera) {
  CameraAxes axes;
  axes.ahead = (camera.focal_point - camera.position).normalized();
  axes.right = axes.ahead.cross(camera.up).normalized();
  axes.up = axes.right.cross(axes.ahead);
  return axes;
}

std::optional<Eigen::Vector2d> pixel_of(const Camera& camera, int width, int height, const Eigen::Vector3d& point) {
  const CameraAxes axes = axes_of(camera);
  const Eigen::Vector3d d = point - camera.position;
  const double depth = d.dot(axes.ahead);
  double pixels_per_m = height / camera.view_height_m;
  if (!camera.orthographic) {
    if (depth <= 1e-6) return std::nullopt;
    pixels_per_m = height / (2.0 * depth * std::tan(camera.view_angle_rad / 2.0));
  }
  return Eigen::Vector2d(width / 2.0 + d.dot(axes.right) * pixels_per_m, height / 2.0 - d.dot(axes.up) * pixels_per_m);
}

std::vector<Eigen::Vector3d> corners(const BoundingBox& box) {
  std::vector<Eigen::Vector3d> points;
  if (box.isEmpty()) return points;
  for (int corner = 0; corner < 8; ++corner) points.push_back(box.corner(static_cast<BoundingBox::CornerType>(corner)));
  return points;
}

Camera fitted(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& ahead, const Eigen::Vector3d& up,
              double aspect) {
  Camera camera;
  camera.orthographic = true;
  camera.up = up;
  camera.position = -ahead.normalized();
  camera.focal_point = Eigen::Vector3d::Zero();
  const CameraAxes axes = axes_of(camera);
  camera.up = axes.up;
  Eigen::AlignedBox3d seen;
  for (const Eigen::Vector3d& p : points)
    seen.extend(Eigen::Vector3d(p.dot(axes.right), p.dot(axes.up), p.dot(axes.ahead)));
  if (seen.isEmpty()) seen.extend(Eigen::Vector3d::Constant(-5.0)).extend(Eigen::Vector3d::Constant(5.0));
  const Eigen::Vector3d middle = seen.center(), size = seen.sizes();
  camera.focal_point = axes.right * middle.x() + axes.up * middle.y() + axes.ahead * middle.z();
  camera.position = camera.focal_point - axes.ahead * (size.norm() + 10.0);
  camera.view_height_m = std::max(0.1, margin * std::max(size.y(), size.x() / aspect));
  return camera;
}

Camera top_view(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& heading, double aspect) {
  return fitted(points, -Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ().cross(level(heading)), aspect);
}

Camera oblique(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& heading, double aspect) {
  const Eigen::Vector3d along = level(heading);
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(along);
  const double down = rad_from_deg(35.0), turn = rad_from_deg(25.0);
  const Eigen::Vector3d flat = std::cos(turn) * left + std::sin(turn) * along;
  return fitted(points, std::cos(down) * flat - std::sin(down) * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(),
                aspect);
}

Camera along_tunnel(const Eigen::Vector3d& eye, const Eigen::Vector3d& ahead) {
  Camera camera;
  camera.position = eye;
  camera.focal_point = eye + ahead.normalized();
  camera.view_angle_rad = rad_from_deg(62.0);
  return camera;
}

}  // namespace adit::render
