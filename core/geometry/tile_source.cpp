#include "core/geometry/tile_source.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

/// Spreads the low 21 bits of a number to every third bit.
std::uint64_t spread_bits(std::uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFFULL;
  x = (x | x << 16) & 0x1F0000FF0000FFULL;
  x = (x | x << 8) & 0x100F00F00F00F00FULL;
  x = (x | x << 4) & 0x10C30C30C30C30C3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

std::vector<Keyed> morton_order(const std::vector<Eigen::Vector3f>& points) {
  BoundingBox box;
  for (const auto& p : points) box.extend(p.cast<double>());
  const double longest = std::max(box.sizes().maxCoeff(), 1e-9);
  const double scale = 2097151.0 / longest;
  std::vector<Keyed> order(points.size());
  parallel_for_each_index(
      points.size(),
      [&](std::size_t i) {
        const Eigen::Vector3d q = (points[i].cast<double>() - box.min()) * scale;
        const auto bits = [](double v) { return spread_bits(static_cast<std::uint64_t>(v)); };
        order[i] = {bits(q.x()) | bits(q.y()) << 1 | bits(q.z()) << 2, static_cast<std::uint32_t>(i)};
      },
      8192);
  tbb::parallel_sort(order.begin(), order.end(), [&](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    const auto& p = points[a.index];
    const auto& q = points[b.index];
    return std::tuple(p.x(), p.y(), p.z(), a.index) < std::tuple(q.x(), q.y(), q.z(), b.index);
  });
  return order;
}

/// Positions 0..n-1 in bit-reversed order: every prefix is spread evenly over the whole.
std::vector<std::size_t> even_prefix_order(std::size_t n) {
  std::vector<std::size_t> order;
  order.reserve(n);
  unsigned bits = 0;
  while ((std::size_t{1} << bits) < n) ++bits;
  for (std::size_t i = 0; i < (std::size_t{1} << bits); ++i) {
    std::size_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1U) << (bits - 1 - b);
    if (reversed < n) order.push_back(reversed);
  }
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
  const std::vector<Keyed> order = morton_order(cloud.points);
  std::vector<std::size_t> indices(n);
  for (std::size_t t = 0; t < tiles; ++t) {
    const std::size_t begin = result.tile_begin[t];
    const auto positions = even_prefix_order(result.tile_begin[t + 1] - begin);
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
