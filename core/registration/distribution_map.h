#pragma once
// A scan as normal distributions, one for each cell of a grid (Magnusson et al., 3D modelling for underground mining
// vehicles, eq. 1 and 2).

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/cell_sums.h"

namespace adit {

/// Points of one cell.
struct NormalDistribution {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< eq. 1 [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< eq. 2, regularised [m2]; zero for a single point
  double points = 1.0;                                   ///< how many there are in the cell
};

struct DistributionOptions {
  double least_points = 5.0;     ///< cells with fewer are left out; two are needed
  double point_sigma_m = 0.005;  ///< noise of a point: no distribution is thinner
  /// Nor is a distribution thinner than this share of its greatest sigma, so that its inverse stays well conditioned.
  double least_sigma_share = 0.03;
};

/// Distributions of one size of cells, found by place. Queries may run on several threads at once.
class DistributionMap {
 public:
  DistributionMap(const std::vector<CellSums>& sums, double cell_m, const DistributionOptions& options);

  double cell_m() const { return cell_m_; }
  const std::vector<NormalDistribution>& distributions() const { return distributions_; }

  /// Calls visit(distribution) for those of the cell that holds the place and of the 26 around it, in a fixed order.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, const Visit& visit) const {
    const Eigen::Vector3d cell = (place / cell_m_).array().floor() + half_cells;
    if (!(cell.minCoeff() >= 1.0 && cell.maxCoeff() < 2.0 * half_cells - 1.0)) return;
    const std::uint64_t key = cell_key(cell);
    for (const std::uint64_t step : neighbour_steps_)
      if (const std::uint32_t slot = slot_of(key + step); slot != none) visit(distributions_[slot]);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  struct Entry {
    std::uint64_t key = ~std::uint64_t{0};
    std::uint32_t slot = none;
  };
  std::uint32_t slot_of(std::uint64_t key) const {
    for (std::uint64_t i = key * 0x9E3779B97F4A7C15ULL >> shift_;; ++i) {
      const Entry& entry = table_[i & (table_.size() - 1)];
      if (entry.slot == none || entry.key == key) return entry.slot;
    }
  }

  double cell_m_;
  std::vector<NormalDistribution> distributions_;
  std::vector<Entry> table_;  ///< open addressing, at most half full; its length is a power of two
  unsigned shift_ = 0;
  std::array<std::uint64_t, 27> neighbour_steps_{};
};

/// One scan in cells of several sizes.
struct DistributionPyramid {
  std::vector<DistributionMap> levels;  ///< finest first; the cells of each are twice as large as those before
};

/// From sums by cells of edge cell_m: levels of 2, 4, ... times cell_m, the last the first of coarsest_m or more.
DistributionPyramid distribution_pyramid(std::vector<CellSums> sums, double cell_m, double coarsest_m,
                                         const DistributionOptions& options);

}  // namespace adit
