#include "core/registration/distribution_map.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <bit>
#include <utility>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

NormalDistribution distribution_of(const CellSums& sums, const DistributionOptions& options) {
  NormalDistribution result;
  result.points = sums.points;
  result.mean = sums.first / sums.points;
  const Eigen::Matrix3d scatter =
      (sums.second - sums.points * result.mean * result.mean.transpose()) / (sums.points - 1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  const double share = options.least_sigma_share * options.least_sigma_share * axes.eigenvalues()[2];
  const double least = std::max(options.point_sigma_m * options.point_sigma_m, share);
  result.covariance =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(least).asDiagonal() * axes.eigenvectors().transpose();
  return result;
}

}  // namespace

DistributionMap::DistributionMap(const std::vector<CellSums>& sums, double cell_m, const DistributionOptions& options)
    : cell_m_(cell_m) {
  std::vector<const CellSums*> kept;
  for (const CellSums& cell : sums)
    if (cell.points >= options.least_points) kept.push_back(&cell);
  distributions_.resize(kept.size());
  parallel_for_each_index(kept.size(), [&](std::size_t i) { distributions_[i] = distribution_of(*kept[i], options); });
  const unsigned bits = static_cast<unsigned>(std::bit_width(2 * kept.size() + 1));
  table_.resize(std::size_t{1} << bits);
  shift_ = 64 - bits;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    std::uint64_t place = kept[i]->key * 0x9E3779B97F4A7C15ULL >> shift_;
    while (table_[place & (table_.size() - 1)].slot != none) ++place;
    table_[place & (table_.size() - 1)] = {kept[i]->key, static_cast<std::uint32_t>(i)};
  }
  std::size_t n = 0;
  for (const std::uint64_t z : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
    for (const std::uint64_t y : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
      for (const std::uint64_t x : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
        neighbour_steps_[n++] = x + (y << 21U) + (z << 42U);
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
