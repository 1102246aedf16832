#pragma once
// The points of a scan summed up cell by cell: what even subsamples and normal distributions come from.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/morton.h"
#include "core/geometry/tile_source.h"

namespace adit {

/// Sums over the points of one cell. They add up to those of larger cells.
struct CellSums {
  std::uint64_t key = 0;  ///< the cell's place (cell_key)
  double points = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< sum of x [m]
  std::array<double, 6> second{};                   ///< sums of xx, xy, xz, yy, yz, zz [m2]

  void add(const Eigen::Vector3d& x) {
    points += 1.0;
    first += x;
    second[0] += x.x() * x.x();
    second[1] += x.x() * x.y();
    second[2] += x.x() * x.z();
    second[3] += x.y() * x.y();
    second[4] += x.y() * x.z();
    second[5] += x.z() * x.z();
  }
  CellSums& operator+=(const CellSums& more);
  Eigen::Vector3d mean() const { return first / points; }
  /// About the mean, of two points and more (n - 1).
  Eigen::Matrix3d covariance() const;
};

/// Cells are numbered by 21 bits an axis; the frame's origin is the lower corner of cell half_cells.
inline constexpr double half_cells = 1048576.0;

/// A place in cells, from 0 on; the whole parts number its cell. Outside of 0 to 2 half_cells there are none.
inline Eigen::Vector3d in_cells(const Eigen::Vector3d& place_m, double cell_m) {
  return (place_m / cell_m).array() + half_cells;
}
inline bool is_numbered(const Eigen::Vector3d& cells) {
  return (cells.array() >= 0.0).all() && (cells.array() < 2.0 * half_cells).all();
}

/// Number of a cell on one axis. Through the signed type: processors have an instruction for that.
inline std::uint64_t cell_number(double in_cells) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(in_cells));
}

/// Key of the cell along a Morton curve.
inline std::uint64_t cell_key(const Eigen::Vector3d& cells) {
  return morton_key(cell_number(cells.x()), cell_number(cells.y()), cell_number(cells.z()));
}

/// Sums by cells of edge cell_m (aligned with the frame's origin), in the order of their keys; the same on any number
/// of threads. Error for points more than a million cells from the origin.
std::vector<CellSums> cell_sums(std::span<const Eigen::Vector3f> points, double cell_m);

/// The same of a stream of tiles; points nearer than least_range_m or farther than most_range_m from the frame's origin
/// are left out. Memory grows with the cells, not with the points: of a dense tile only an even prefix is read, about
/// 64 points for each cell its box may touch.
std::vector<CellSums> cell_sums(const TileSource& source, double cell_m, double least_range_m, double most_range_m,
                                Progress& progress);

/// The sums of cells twice as large, in the order of their keys.
std::vector<CellSums> with_double_cells(std::vector<CellSums> sums);

}  // namespace adit
