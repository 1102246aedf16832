#include "core/registration/overlap_section.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr double radius_m = 20.0;
constexpr double least_half_thickness_m = 0.02;
constexpr double most_half_thickness_m = 0.04;
constexpr std::size_t enough_points = 250;  // of each scan

bool touches(const BoundingBox& box, const Eigen::Vector3d& centre, const Eigen::Vector3d& normal,
             double half_thickness_m) {
  const double reach = 0.5 * box.sizes().dot(normal.cwiseAbs()) + half_thickness_m;
  return std::abs(normal.dot(box.center() - centre)) <= reach && box.exteriorDistance(centre) <= radius_m;
}

std::vector<Eigen::Vector2f> even_part(const std::vector<Eigen::Vector2f>& points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<Eigen::Vector2f> kept;
  for (std::size_t i = 0; i < most; ++i) kept.push_back(points[i * points.size() / most]);
  return kept;
}

/// Points of a thin part of the scan by their place along a line through the middle, in steps of a metre.
using AlongLine = std::array<std::size_t, 2 * static_cast<std::size_t>(radius_m) + 1>;
AlongLine along_line(const TileSource& scan, const Pose& local_from_scan, const Eigen::Vector3d& middle,
                     const Eigen::Vector3d& ahead) {
  constexpr std::size_t of_a_tile = 500;
  AlongLine counts{};
  for (std::size_t tile = 0; tile < scan.tile_count(); ++tile)
    for (const auto& p : scan.positions(tile, of_a_tile)) {
      const Eigen::Vector3d arm = local_from_scan * p.cast<double>() - middle;
      const double place = ahead.dot(arm) + radius_m + 0.5;
      if (arm.norm() < radius_m) ++counts[static_cast<std::size_t>(std::max(0.0, place))];
    }
  return counts;
}

/// Metres ahead of the middle: there, when it is seen well enough, else where the scan that sees less sees most.
double best_seen_m(const TileSource& target, const Pose& local_from_target, const TileSource& source,
                   const Pose& local_from_source, const Eigen::Vector3d& middle, const Eigen::Vector3d& ahead) {
  constexpr double well_enough = 0.3;  // of the most
  const AlongLine of_target = along_line(target, local_from_target, middle, ahead);
  const AlongLine of_source = along_line(source, local_from_source, middle, ahead);
  const auto both = [&](std::size_t i) { return std::min(of_target[i], of_source[i]); };
  std::size_t best = of_target.size() / 2;
  std::size_t most = best;
  for (std::size_t i = 0; i < of_target.size(); ++i)
    if (both(i) > both(most)) most = i;
  if (static_cast<double>(both(best)) < well_enough * static_cast<double>(both(most))) best = most;
  return static_cast<double>(best) - radius_m;
}

std::vector<Eigen::Vector2f> points_of(const TileSource& scan, const Pose& local_from_scan,
                                       const OverlapSection& section, const Progress& progress) {
  const double half_thickness_m = section.half_thickness_m;
  const Pose scan_from_local = local_from_scan.inverse();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d normal = section.right.cross(up);
  const Eigen::Vector3d centre = scan_from_local * section.centre;
  const Eigen::Vector3d normal_in_scan = scan_from_local.linear() * normal;
  std::vector<Eigen::Vector2f> points;
  for (std::size_t tile = 0; tile < scan.tile_count(); ++tile) {
    progress.check();
    if (!touches(scan.box(tile), centre, normal_in_scan, half_thickness_m)) continue;
    for (const auto& p : scan.positions(tile)) {
      const Eigen::Vector3d arm = p.cast<double>() - centre;
      if (std::abs(normal_in_scan.dot(arm)) > half_thickness_m || arm.norm() > radius_m) continue;
      const Eigen::Vector3d local = local_from_scan.linear() * arm;
      points.emplace_back(Eigen::Vector2d(local.dot(section.right), local.dot(up)).cast<float>());
    }
  }
  return points;
}

}  // namespace

OverlapSection overlap_section(const TileSource& target, const Pose& local_from_target, const TileSource& source,
                               const Pose& local_from_source, std::size_t most_points, const Progress& progress) {
  OverlapSection section;
  const Eigen::Vector3d middle = 0.5 * (local_from_target.translation() + local_from_source.translation());
  Eigen::Vector3d ahead = local_from_source.translation() - local_from_target.translation();
  ahead.z() = 0.0;
  if (ahead.norm() < 0.3) ahead = Eigen::Vector3d::UnitY();  // both scans from one place: any section will do
  ahead.normalize();
  section.centre = middle + best_seen_m(target, local_from_target, source, local_from_source, middle, ahead) * ahead;
  section.right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
  for (section.half_thickness_m = least_half_thickness_m;; section.half_thickness_m *= 2.0) {
    section.target = points_of(target, local_from_target, section, progress);
    section.source = points_of(source, local_from_source, section, progress);
    if (std::min(section.target.size(), section.source.size()) >= std::min(enough_points, most_points)) break;
    if (section.half_thickness_m >= most_half_thickness_m) break;
  }
  section.target = even_part(section.target, most_points);
  section.source = even_part(section.source, most_points);
  return section;
}

}  // namespace adit
