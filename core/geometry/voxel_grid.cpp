#include "core/geometry/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <tuple>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr double points_a_cube = 64.0;
constexpr std::size_t tiles_at_once = 64;

struct Keyed {
  std::uint64_t key;
  Eigen::Vector3f point;
};

/// The points of one cube so far.
struct Cube {
  std::uint64_t key = 0;
  std::uint64_t count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
};
using Cubes = std::vector<Cube>;  // in the order of their keys

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

Cubes cubes_of(std::vector<Keyed>& keyed) {
  std::sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) {
    if (a.key != b.key) return a.key < b.key;
    return std::tuple(a.point.x(), a.point.y(), a.point.z()) < std::tuple(b.point.x(), b.point.y(), b.point.z());
  });
  Cubes cubes;
  for (const Keyed& point : keyed) {
    if (cubes.empty() || cubes.back().key != point.key) cubes.push_back({point.key, 0, Eigen::Vector3d::Zero()});
    ++cubes.back().count;
    cubes.back().sum += point.point.cast<double>();
  }
  return cubes;
}

/// Both lists as one; cubes that are in both add up, those of `more` behind.
Cubes merged(const Cubes& cubes, const Cubes& more) {
  Cubes result;
  result.reserve(cubes.size() + more.size());
  auto a = cubes.begin();
  auto b = more.begin();
  while (a != cubes.end() || b != more.end()) {
    if (b == more.end() || (a != cubes.end() && a->key < b->key)) {
      result.push_back(*a++);
    } else if (a == cubes.end() || b->key < a->key) {
      result.push_back(*b++);
    } else {
      result.push_back({a->key, a->count + b->count, a->sum + b->sum});
      ++a;
      ++b;
    }
  }
  return result;
}

/// Pairs, pairs of pairs, ...: always in the order of the tiles.
Cubes merged(std::vector<Cubes> lists) {
  while (lists.size() > 1) {
    std::vector<Cubes> half((lists.size() + 1) / 2);
    parallel_for_each_index(
        half.size(),
        [&](std::size_t i) {
          half[i] = 2 * i + 1 < lists.size() ? merged(lists[2 * i], lists[2 * i + 1]) : std::move(lists[2 * i]);
        },
        1);
    lists = std::move(half);
  }
  return lists.empty() ? Cubes() : std::move(lists.front());
}

PointCloud means(const Cubes& cubes) {
  PointCloud result;
  result.points.reserve(cubes.size());
  for (const Cube& cube : cubes) result.points.push_back((cube.sum / static_cast<double>(cube.count)).cast<float>());
  return result;
}

/// Enough of a tile: a surface through its box touches about as many cubes as the box's two longer sides say.
std::size_t enough_points(const BoundingBox& box, double spacing_m) {
  Eigen::Vector3d sides = box.sizes() / spacing_m;
  std::sort(sides.data(), sides.data() + 3);
  return static_cast<std::size_t>(std::min(points_a_cube * (sides[2] + 1.0) * (sides[1] + 1.0), 1e9));
}

}  // namespace

PointCloud even_subsample(const PointCloud& cloud, double spacing_m) {
  std::vector<Keyed> keyed(cloud.size());
  for (std::size_t i = 0; i < keyed.size(); ++i) keyed[i] = {cube_key(cloud.points[i], spacing_m), cloud.points[i]};
  return means(cubes_of(keyed));
}

PointCloud even_subsample(const TileSource& source, double spacing_m, double least_range_m, double most_range_m,
                          Progress& progress) {
  const std::size_t tiles = source.tile_count();
  std::vector<Cubes> groups((tiles + tiles_at_once - 1) / tiles_at_once);
  parallel_for_each_index(
      groups.size(),
      [&](std::size_t g) {
        std::vector<Cubes> lists;
        for (std::size_t t = g * tiles_at_once; t < std::min(tiles, (g + 1) * tiles_at_once); ++t) {
          progress.step(t, tiles);
          std::vector<Keyed> keyed;
          for (const auto& p : source.positions(t, enough_points(source.box(t), spacing_m))) {
            const double range = p.cast<double>().norm();
            if (range >= least_range_m && range <= most_range_m) keyed.push_back({cube_key(p, spacing_m), p});
          }
          lists.push_back(cubes_of(keyed));
        }
        groups[g] = merged(std::move(lists));
      },
      1);
  return means(merged(std::move(groups)));
}

}  // namespace adit
