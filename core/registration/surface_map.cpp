#include "core/registration/surface_map.h"

#include <algorithm>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

// Of planes: what bends more is the edge of something, which each scanner sees from its own side.
constexpr double most_bend = 0.08;

/// Zero where there is no surface near.
Eigen::Vector3d normal_at(const DistributionMap& planes, const Eigen::Vector3d& place) {
  const double reach2 = planes.cell_m() * planes.cell_m();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
  double least = reach2;
  planes.visit_near(place, [&](const NormalDistribution& plane) {
    const double squared = (plane.mean - place).squaredNorm();
    if (!plane.flat || plane.bend > most_bend || squared >= reach2) return;
    sum += near_weight(squared / reach2) * plane.normal * plane.normal.transpose();
    if (squared < least) nearest = plane.normal;
    least = std::min(least, squared);
  });
  // Towards the greatest eigenvector, whatever the signs; one step of the power method is close enough.
  const Eigen::Vector3d normal = sum * nearest;
  return normal.isZero() ? normal : normal.normalized();
}

}  // namespace

SurfaceMap::SurfaceMap(const std::vector<CellSums>& sums, double cell_m, std::span<const DistributionMap> planes,
                       bool seen_from_origin)
    : seen_from_origin_(seen_from_origin) {
  std::vector<Eigen::Vector3f> normals(sums.size());
  parallel_for_each_index(sums.size(), [&](std::size_t i) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t n = 0; n < planes.size() && normal.isZero(); ++n) normal = normal_at(planes[n], sums[i].mean());
    normals[i] = normal.cast<float>();
  });
  std::vector<std::uint64_t> keys;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!(normals[i].squaredNorm() > 0.5F)) continue;
    pieces_.push_back({sums[i].mean().cast<float>(), normals[i]});
    keys.push_back(sums[i].key);
  }
  index_ = CellIndex(keys, cell_m);
}

}  // namespace adit
