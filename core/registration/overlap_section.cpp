#include "core/registration/overlap_section.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double radius_m = 20.0;
constexpr double least_half_thickness_m = 0.02;
constexpr double most_half_thickness_m = 0.16;
constexpr std::size_t enough_points = 600;  // of each scan

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
  section.centre = 0.5 * (local_from_target.translation() + local_from_source.translation());
  Eigen::Vector3d ahead = local_from_source.translation() - local_from_target.translation();
  ahead.z() = 0.0;
  if (ahead.norm() < 0.3) ahead = Eigen::Vector3d::UnitY();  // both scans from one place: any section will do
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
