#pragma once
// The points of a scan summed up cell by cell: what even subsamples and normal distributions come from.

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/tile_source.h"

namespace adit {

/// Sums over the points of one cell. They add up to those of larger cells.
struct CellSums {
  std::uint64_t key = 0;  ///< the cell's place (cell_key)
  double points = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< sum of x [m]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< sum of x x^T [m2]

  Eigen::Vector3d mean() const { return first / points; }
};

/// Cells are numbered by 21 bits an axis, x lowest; the frame's origin is the lower corner of cell half_cells.
inline constexpr double half_cells = 1048576.0;
inline std::uint64_t cell_key(const Eigen::Vector3d& cell) {
  return static_cast<std::uint64_t>(cell.x()) | static_cast<std::uint64_t>(cell.y()) << 21U |
         static_cast<std::uint64_t>(cell.z()) << 42U;
}

/// Sums by cells of edge cell_m (aligned with the frame's origin), in the order of their keys; the same on any number
/// of threads. Error for points more than a million cells from the origin.
std::vector<CellSums> cell_sums(std::span<const Eigen::Vector3f> points, double cell_m);

/// The same of a stream of tiles; points nearer than least_range_m or farther than most_range_m from the frame's origin
/// are left out. Memory grows with the cells, not with the points: of a dense tile only an even prefix is read, about
/// 64 points for each cell its box may touch.
std::vector<CellSums> cell_sums(const TileSource& source, double cell_m, double least_range_m, double most_range_m,
                                Progress& progress);

/// The sums of cells twice as large.
std::vector<CellSums> with_double_cells(std::vector<CellSums> sums);

}  // namespace adit
