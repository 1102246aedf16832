#include "core/georeference/target_plane.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace adit {
namespace {

TargetPlane plane_of(const std::vector<Eigen::Vector3d>& points) {
  TargetPlane plane;
  for (const Eigen::Vector3d& point : points) plane.middle += point / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) spread += (point - plane.middle) * (point - plane.middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  plane.normal = solver.eigenvectors().col(0);
  if (plane.normal.dot(plane.middle) > 0.0) plane.normal = -plane.normal;
  plane.points = static_cast<int>(points.size());
  plane.rms_m = std::sqrt(std::max(0.0, solver.eigenvalues()(0)) / std::max(1, plane.points - 3));
  return plane;
}

}  // namespace

std::optional<TargetPlane> target_plane(const ScanView& view, const Eigen::Vector2d& center, double reach_px,
                                        const std::function<bool(const Eigen::Vector2d&)>& inside) {
  constexpr int rounds = 4;
  constexpr std::size_t least_points = 12;
  constexpr double least_cosine = 0.17, least_limit_m = 0.001, inner_share = 0.6;
  std::vector<Eigen::Vector3d> points, inner;  // rock behind the rim must not turn the plane that the rest is judged by
  const int side = view.grey.width;
  for (int v = std::max(0, static_cast<int>(center.y() - reach_px)); v < std::min<double>(side, center.y() + reach_px);
       ++v)
    for (int u = std::max(0, static_cast<int>(center.x() - reach_px));
         u < std::min<double>(side, center.x() + reach_px); ++u)
      if (view.has_point(u, v) && inside({u, v})) {
        points.push_back(view.point(u, v));
        if ((Eigen::Vector2d(u, v) - center).norm() < inner_share * reach_px) inner.push_back(points.back());
      }
  if (points.size() < least_points) return std::nullopt;
  TargetPlane plane = plane_of(inner.size() < least_points ? points : inner);
  for (int round = 0; round < rounds; ++round) {
    const double limit_m = std::max(least_limit_m, 3.0 * plane.rms_m);
    std::vector<Eigen::Vector3d> near;
    for (const Eigen::Vector3d& point : points)
      if (std::abs(plane.normal.dot(point - plane.middle)) <= limit_m) near.push_back(point);
    if (near.size() < least_points) return std::nullopt;
    plane = plane_of(near);
  }
  if (-plane.normal.dot(plane.middle.normalized()) < least_cosine) return std::nullopt;
  return plane;
}

PlanePlace place_on_plane(const ScanView& view, const TargetPlane& plane, const Eigen::Vector2d& pixel,
                          const Eigen::Matrix2d& covariance_px2) {
  const Eigen::Vector3d direction = view.direction(pixel);
  PlanePlace place;
  place.at = plane.met_by(direction);
  Eigen::Matrix<double, 3, 2> by_pixel;
  for (int k = 0; k < 2; ++k)
    by_pixel.col(k) = plane.met_by(view.direction(pixel + Eigen::Vector2d::Unit(k))) - place.at;
  const double along_m = plane.sigma_along_m(direction);
  const Eigen::Matrix3d covariance =
      by_pixel * covariance_px2 * by_pixel.transpose() + along_m * along_m * direction * direction.transpose();
  place.sigma_m = std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(2)));
  return place;
}

}  // namespace adit
