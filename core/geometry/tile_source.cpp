#include "core/geometry/tile_source.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "core/foundation/parallel.h"
#include "core/geometry/morton.h"

namespace adit {
namespace {

std::vector<KeyedIndex> morton_order(const std::vector<Eigen::Vector3f>& points) {
  BoundingBox box;
  for (const auto& p : points) box.extend(p.cast<double>());
  const double longest = std::max(box.sizes().maxCoeff(), 1e-9);
  const double scale = 2097151.0 / longest;
  std::vector<KeyedIndex> order(points.size());
  parallel_for_each_index(
      points.size(),
      [&](std::size_t i) {
        const Eigen::Vector3d q = (points[i].cast<double>() - box.min()) * scale;
        order[i] = {morton_key(static_cast<std::uint64_t>(q.x()), static_cast<std::uint64_t>(q.y()),
                               static_cast<std::uint64_t>(q.z())),
                    static_cast<std::uint32_t>(i)};
      },
      8192);
  tbb::parallel_sort(order.begin(), order.end(), [&](const KeyedIndex& a, const KeyedIndex& b) {
    if (a.key != b.key) return a.key < b.key;
    const auto& p = points[a.index];
    const auto& q = points[b.index];
    return std::tuple(p.x(), p.y(), p.z(), a.index) < std::tuple(q.x(), q.y(), q.z(), b.index);
  });
  return order;
}

}  // namespace

std::size_t total_points(const TileSource& source) {
  std::size_t sum = 0;
  for (std::size_t tile = 0; tile < source.tile_count(); ++tile) sum += source.point_count(tile);
  return sum;
}

TiledCloud tiled(PointCloud cloud, std::size_t tile_size) {
  const std::size_t n = cloud.size();
  const std::size_t tiles = (n + tile_size - 1) / tile_size;
  TiledCloud result;
  for (std::size_t t = 0; t <= tiles; ++t) result.tile_begin.push_back(tiles == 0 ? 0 : n * t / tiles);
  const std::vector<KeyedIndex> order = morton_order(cloud.points);
  std::vector<std::size_t> indices(n);
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::size_t begin = result.tile_begin[t];
    const auto positions = even_prefix_order(static_cast<std::uint32_t>(result.tile_begin[t + 1] - begin));
    for (std::size_t i = 0; i < positions.size(); ++i) indices[begin + i] = order[begin + positions[i]].index;
  }
  result.cloud = selected(cloud, indices);
  return result;
}

BoundingBox CloudTiles::box(std::size_t tile) const {
  BoundingBox box;
  for (std::size_t i = tiled_.tile_begin[tile]; i < tiled_.tile_begin[tile + 1]; ++i)
    box.extend(tiled_.cloud.points[i].cast<double>());
  return box;
}

PointCloud CloudTiles::read(std::size_t tile, std::size_t prefix) const {
  std::vector<std::size_t> indices(std::min(prefix, point_count(tile)));
  std::iota(indices.begin(), indices.end(), tiled_.tile_begin[tile]);
  return selected(tiled_.cloud, indices);
}

}  // namespace adit
