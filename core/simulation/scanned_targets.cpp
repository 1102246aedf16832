#include "core/simulation/scanned_targets.h"

#include <cmath>

namespace adit {
namespace {

constexpr double paper = 0.85, ink = 0.07, shell = 0.8;  // a sphere's paint

std::optional<TargetHit> sphere_hit(const ScannedTarget& target, const Eigen::Vector3d& origin,
                                    const Eigen::Vector3d& direction) {
  const Eigen::Vector3d to = target.pose.translation() - origin;
  const double along = to.dot(direction), beside2 = to.squaredNorm() - along * along;
  const double radius2 = target.radius_m * target.radius_m;
  if (along <= 0.0 || beside2 >= radius2) return std::nullopt;
  const double depth = std::sqrt(radius2 - beside2);
  return TargetHit{along - depth, depth / target.radius_m, shell};
}

std::optional<TargetHit> board_hit(const ScannedTarget& target, const Eigen::Vector3d& origin,
                                   const Eigen::Vector3d& direction) {
  const Eigen::Vector3d normal = target.pose.linear().col(2);
  const double cosine = -normal.dot(direction);
  if (cosine <= 0.0) return std::nullopt;
  const double range_m = normal.dot(origin - target.pose.translation()) / cosine;
  if (range_m <= 0.0) return std::nullopt;
  const Eigen::Vector3d on =
      target.pose.linear().transpose() * (origin + range_m * direction - target.pose.translation());
  if (on.head<2>().norm() > board_radius_m(target)) return std::nullopt;
  const double x = on.x() / target.radius_m, y = on.y() / target.radius_m;
  const bool black = target.kind == TargetKind::coded ? is_black_at(target.code, x, y) : x * y > 0.0;
  return TargetHit{range_m, cosine, black ? ink : paper};
}

}  // namespace

double board_radius_m(const ScannedTarget& target) {
  return target.kind == TargetKind::coded ? coded_pattern::clear_radius * target.radius_m : target.radius_m;
}

std::optional<TargetHit> first_target_hit(const std::vector<ScannedTarget>& targets, const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction) {
  std::optional<TargetHit> first;
  for (const ScannedTarget& target : targets) {
    const Eigen::Vector3d to = target.pose.translation() - origin;
    // Far beside the line: most are.
    if (to.cross(direction).squaredNorm() > std::pow(board_radius_m(target), 2)) continue;
    const auto hit = target.kind == TargetKind::sphere ? sphere_hit(target, origin, direction)
                                                       : board_hit(target, origin, direction);
    if (hit && (!first || hit->range_m < first->range_m)) first = hit;
  }
  return first;
}

}  // namespace adit
