#include "core/registration/distribution_map.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

NormalDistribution distribution_of(const CellSums& sums, const DistributionOptions& options) {
  NormalDistribution result;
  result.points = sums.points;
  result.mean = sums.mean();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(sums.covariance());
  const double share = options.least_sigma_share * options.least_sigma_share * axes.eigenvalues()[2];
  const double least = std::max(options.point_sigma_m * options.point_sigma_m, share);
  const Eigen::Vector3d values = axes.eigenvalues().cwiseMax(0.0);
  result.normal = axes.eigenvectors().col(0);
  result.thickness_m = std::sqrt(values[0]);
  result.bend = values[1] > 0.0 ? values[0] / values[1] : 1.0;
  result.flat = values[0] < 0.2 * values[1] && values[1] > 0.05 * values[2];
  result.covariance =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(least).asDiagonal() * axes.eigenvectors().transpose();
  return result;
}

}  // namespace

DistributionMap::DistributionMap(const std::vector<CellSums>& sums, double cell_m, const DistributionOptions& options) {
  std::vector<const CellSums*> kept;
  std::vector<std::uint64_t> keys;
  for (const CellSums& cell : sums) {
    if (cell.points < options.least_points) continue;
    kept.push_back(&cell);
    keys.push_back(cell.key);
  }
  distributions_.resize(kept.size());
  parallel_for_each_index(kept.size(), [&](std::size_t i) { distributions_[i] = distribution_of(*kept[i], options); });
  index_ = CellIndex(keys, cell_m);
}

std::size_t DistributionPyramid::level_near(double cell_m, std::size_t first) const {
  const auto off = [&](std::size_t level) { return std::abs(std::log2(levels[level].cell_m() / cell_m)); };
  std::size_t best = first;
  for (std::size_t level = first + 1; level < levels.size(); ++level)
    if (off(level) < off(best)) best = level;
  return best;
}

DistributionPyramid distribution_pyramid(std::vector<CellSums> sums, double cell_m, double coarsest_m,
                                         const DistributionOptions& options) {
  DistributionPyramid pyramid;
  do {
    sums = with_double_cells(std::move(sums));
    cell_m *= 2.0;
    pyramid.levels.emplace_back(sums, cell_m, options);
  } while (cell_m < coarsest_m);
  return pyramid;
}

}  // namespace adit
