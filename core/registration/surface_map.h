#pragma once
// A scan as small pieces of surface: what the last refinement lays upon each other.

#include <Eigen/Core>

#include <span>
#include <vector>

#include "core/geometry/cell_index.h"
#include "core/registration/distribution_map.h"

namespace adit {

/// How much a piece of surface counts at a distance: as a Gaussian of about 0.4 reaches would, but over at one reach
/// without a step. share2: squared distance over squared reach, under 1.
inline double near_weight(double share2) {
  const double left = 1.0 - share2;
  return left * left * left;
}

/// The mean of one cell's points with the normal of the surface around it (either way), from the planes of the larger
/// cells around it by near_weight.
struct SurfacePiece {
  Eigen::Vector3f place = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
};

/// Pieces of one size, found by place. Queries may run on several threads at once.
class SurfaceMap {
 public:
  SurfaceMap() = default;
  /// A piece for every cell of edge cell_m near which `planes` know a surface: maps of larger cells, the finest first;
  /// the first that knows one is asked. seen_from_origin: whether the scanner stood at the origin.
  SurfaceMap(const std::vector<CellSums>& sums, double cell_m, std::span<const DistributionMap> planes,
             bool seen_from_origin = false);

  double cell_m() const { return index_.cell_m(); }
  const std::vector<SurfacePiece>& pieces() const { return pieces_; }
  bool seen_from_origin() const { return seen_from_origin_; }

  /// Calls visit(piece) for those of the cell that holds the place and of the 26 around it, in a fixed order.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, const Visit& visit) const {
    index_.visit_near(place, [&](std::size_t slot) { visit(pieces_[slot]); });
  }

 private:
  std::vector<SurfacePiece> pieces_;
  CellIndex index_;
  bool seen_from_origin_ = false;
};

}  // namespace adit
