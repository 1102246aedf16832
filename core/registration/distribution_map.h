#pragma once
// A scan as normal distributions, one for each cell of a grid (Magnusson et al., 3D modelling for underground mining
// vehicles, eq. 1 and 2).

#include <Eigen/Core>

#include <vector>

#include "core/geometry/cell_index.h"
#include "core/geometry/cell_sums.h"

namespace adit {

/// Points of one cell.
struct NormalDistribution {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< eq. 1 [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< eq. 2, regularised [m2]; zero for a single point
  double points = 1.0;                                   ///< how many there are in the cell
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();     ///< of the plane through the points; either way
  double thickness_m = 0.0;                              ///< sigma of the points about that plane, as measured
  bool flat = false;                                     ///< the points are a piece of surface
  double bend = 1.0;                                     ///< variance off the plane over the lesser one within it
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

  double cell_m() const { return index_.cell_m(); }
  const std::vector<NormalDistribution>& distributions() const { return distributions_; }

  /// Calls visit(distribution) for those of the cell that holds the place and of the 26 around it, in a fixed order.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, const Visit& visit) const {
    index_.visit_near(place, [&](std::size_t slot) { visit(distributions_[slot]); });
  }

 private:
  std::vector<NormalDistribution> distributions_;
  CellIndex index_;
};

/// One scan in cells of several sizes.
struct DistributionPyramid {
  std::vector<DistributionMap> levels;  ///< finest first; the cells of each are twice as large as those before

  /// The level whose cells are nearest in size, by ratio; those before `first` do not count.
  std::size_t level_near(double cell_m, std::size_t first = 0) const;
};

/// From sums by cells of edge cell_m: levels of 2, 4, ... times cell_m, the last the first of coarsest_m or more.
DistributionPyramid distribution_pyramid(std::vector<CellSums> sums, double cell_m, double coarsest_m,
                                         const DistributionOptions& options);

}  // namespace adit
