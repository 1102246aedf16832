#include "core/geometry/voxel_grid.h"

#include <algorithm>
#include <tuple>

#include "core/geometry/cell_sums.h"

namespace adit {
namespace {

PointCloud means(const std::vector<CellSums>& cells) {
  PointCloud result;
  result.points.reserve(cells.size());
  for (const CellSums& cell : cells) result.points.push_back(cell.mean().cast<float>());
  return result;
}

}  // namespace

PointCloud even_subsample(const PointCloud& cloud, double spacing_m) {
  // Sums in another order could differ in their last bit.
  std::vector<Eigen::Vector3f> points = cloud.points;
  std::sort(points.begin(), points.end(), [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
  });
  return means(cell_sums(points, spacing_m));
}

PointCloud even_subsample(const TileSource& source, double spacing_m, double least_range_m, double most_range_m,
                          Progress& progress) {
  return means(cell_sums(source, spacing_m, least_range_m, most_range_m, progress));
}

}  // namespace adit
