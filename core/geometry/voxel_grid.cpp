#include "core/geometry/voxel_grid.h"

#include <tbb/parallel_sort.h>

#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

struct Keyed {
  std::uint64_t key;
  Eigen::Vector3f point;
};

std::uint64_t cube_key(const Eigen::Vector3f& point, double spacing_m) {
  constexpr double half = 1048576.0;  // 21 bits an axis
  std::uint64_t key = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const double index = std::floor(static_cast<double>(point[axis]) / spacing_m) + half;
    if (!(index >= 0.0 && index < 2.0 * half))
      throw Error("a point lies too far from the scanner for a subsample at " + std::to_string(spacing_m) + " m", "",
                  "remove stray points or use a larger spacing");
    key = key << 21 | static_cast<std::uint64_t>(index);
  }
  return key;
}

PointCloud cube_means(std::vector<Keyed>& keyed) {
  tbb::parallel_sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    return std::tuple(a.point.x(), a.point.y(), a.point.z()) < std::tuple(b.point.x(), b.point.y(), b.point.z());
  });
  PointCloud result;
  for (std::size_t begin = 0; begin < keyed.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t end = begin;
    for (; end < keyed.size() && keyed[end].key == keyed[begin].key; ++end) sum += keyed[end].point.cast<double>();
    result.points.push_back((sum / static_cast<double>(end - begin)).cast<float>());
    begin = end;
  }
  return result;
}

}  // namespace

PointCloud even_subsample(const PointCloud& cloud, double spacing_m) {
  std::vector<Keyed> keyed(cloud.size());
  parallel_for_each_index(
      cloud.size(),
      [&](std::size_t i) {
        keyed[i] = {cube_key(cloud.points[i], spacing_m), cloud.points[i]};
      },
      8192);
  return cube_means(keyed);
}

PointCloud even_subsample(const TileSource& source, double spacing_m, double least_range_m, double most_range_m,
                          Progress& progress) {
  std::vector<Keyed> keyed;
  std::vector<std::vector<Keyed>> tiles(source.tile_count());
  parallel_for_each_index(
      source.tile_count(),
      [&](std::size_t t) {
        progress.step(t, source.tile_count());
        for (const auto& p : source.read(t).points) {
          const double range = p.cast<double>().norm();
          if (range >= least_range_m && range <= most_range_m) tiles[t].push_back({cube_key(p, spacing_m), p});
        }
      },
      1);
  for (auto& tile : tiles) keyed.insert(keyed.end(), tile.begin(), tile.end());
  return cube_means(keyed);
}

}  // namespace adit
