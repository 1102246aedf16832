#include "core/geometry/cell_sums.h"

#include <algorithm>
#include <utility>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr std::size_t block_points = 131072;  // fixed, so that sums do not depend on the threads
constexpr double points_a_cell = 64.0;

/// Whole numbers of a cell, packed: cheaper than the curve's key for every point.
std::uint64_t packed_cell(const Eigen::Vector3d& x, double cell_m) {
  const Eigen::Vector3d cells = in_cells(x, cell_m);
  if (!is_numbered(cells))
    throw Error("a point lies too far from the scanner for cells of " + std::to_string(cell_m) + " m", "",
                "remove stray points or use larger cells");
  return cell_number(cells.x()) | cell_number(cells.y()) << 21U | cell_number(cells.z()) << 42U;
}

std::uint64_t key_of_packed(std::uint64_t cell) {
  return morton_key(cell, cell >> 21U, cell >> 42U);  // each looks at its low 21 bits
}

/// Cells of a block of points, by open addressing while they come, in order at the end.
class BlockSums {
 public:
  BlockSums() { grow(1024); }

  void add(const Eigen::Vector3d& x, double cell_m) { cell_of(packed_cell(x, cell_m)).add(x); }

  std::vector<CellSums> in_order() const {
    std::vector<KeyedIndex> order;
    order.reserve(cells_.size());
    for (const CellSums& cell : cells_)
      order.push_back({key_of_packed(cell.key), static_cast<std::uint32_t>(order.size())});
    std::sort(order.begin(), order.end(), [](const KeyedIndex& a, const KeyedIndex& b) { return a.key < b.key; });
    std::vector<CellSums> sums;
    sums.reserve(cells_.size());
    for (const KeyedIndex& next : order) {
      sums.push_back(cells_[next.index]);
      sums.back().key = next.key;
    }
    return sums;
  }

 private:
  CellSums& cell_of(std::uint64_t key) {
    if (last_ < cells_.size() && cells_[last_].key == key) return cells_[last_];  // neighbours follow one another
    if (2 * cells_.size() >= slots_.size()) grow(2 * slots_.size());
    std::size_t i = place_of(key);
    while (slots_[i] != 0 && cells_[slots_[i] - 1].key != key) i = (i + 1) & (slots_.size() - 1);
    if (slots_[i] == 0) {
      cells_.emplace_back().key = key;
      slots_[i] = static_cast<std::uint32_t>(cells_.size());
    }
    last_ = slots_[i] - 1;
    return cells_[last_];
  }
  std::size_t place_of(std::uint64_t key) const {
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15ULL >> 20) & (slots_.size() - 1);
  }
  void grow(std::size_t slots) {
    slots_.assign(slots, 0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      std::size_t i = place_of(cells_[c].key);
      while (slots_[i] != 0) i = (i + 1) & (slots_.size() - 1);
      slots_[i] = static_cast<std::uint32_t>(c + 1);
    }
  }
  std::vector<CellSums> cells_;
  std::vector<std::uint32_t> slots_;  // 1 + place in cells_; 0: empty
  std::size_t last_ = 0;
};

/// Two lists in order as one; cells that are in both add up.
std::vector<CellSums> merged(const std::vector<CellSums>& a, const std::vector<CellSums>& b) {
  std::vector<CellSums> result;
  result.reserve(a.size() + b.size());
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < a.size() || k < b.size()) {
    if (k == b.size() || (i < a.size() && a[i].key < b[k].key)) {
      result.push_back(a[i++]);
    } else if (i == a.size() || b[k].key < a[i].key) {
      result.push_back(b[k++]);
    } else {
      result.push_back(a[i++]);
      result.back() += b[k++];
    }
  }
  return result;
}

/// Pairs, pairs of pairs, ...: always in the same order.
std::vector<CellSums> merged(std::vector<std::vector<CellSums>> lists) {
  while (lists.size() > 1) {
    std::vector<std::vector<CellSums>> half((lists.size() + 1) / 2);
    parallel_for_each_index(
        half.size(),
        [&](std::size_t i) {
          half[i] = 2 * i + 1 < lists.size() ? merged(lists[2 * i], lists[2 * i + 1]) : std::move(lists[2 * i]);
        },
        1);
    lists = std::move(half);
  }
  return lists.empty() ? std::vector<CellSums>() : std::move(lists.front());
}

/// Enough of a tile: a surface through its box touches about as many cells as the box's two longer sides say.
std::size_t enough_points(const BoundingBox& box, double cell_m) {
  Eigen::Vector3d sides = box.sizes() / cell_m;
  std::sort(sides.data(), sides.data() + 3);
  return static_cast<std::size_t>(std::min(points_a_cell * (sides[2] + 1.0) * (sides[1] + 1.0), 1e9));
}

}  // namespace

CellSums& CellSums::operator+=(const CellSums& more) {
  points += more.points;
  first += more.first;
  for (std::size_t i = 0; i < second.size(); ++i) second[i] += more.second[i];
  return *this;
}

Eigen::Matrix3d CellSums::covariance() const {
  Eigen::Matrix3d squares;
  squares << second[0], second[1], second[2], second[1], second[3], second[4], second[2], second[4], second[5];
  const Eigen::Vector3d middle = mean();
  return (squares - points * middle * middle.transpose()) / (points - 1.0);
}

std::vector<CellSums> cell_sums(std::span<const Eigen::Vector3f> points, double cell_m) {
  std::vector<std::vector<CellSums>> parts((points.size() + block_points - 1) / block_points);
  parallel_blocks(points.size(), block_points, [&](std::size_t begin, std::size_t end) {
    BlockSums sums;
    for (std::size_t i = begin; i < end; ++i) sums.add(points[i].cast<double>(), cell_m);
    parts[begin / block_points] = sums.in_order();
  });
  return merged(std::move(parts));
}

std::vector<CellSums> cell_sums(const TileSource& source, double cell_m, double least_range_m, double most_range_m,
                                Progress& progress) {
  const std::size_t tiles = source.tile_count();
  std::vector<std::vector<CellSums>> parts(tiles);
  parallel_for_each_index(
      tiles,
      [&](std::size_t t) {
        progress.step(t, tiles);
        BlockSums sums;
        for (const auto& p : source.positions(t, enough_points(source.box(t), cell_m))) {
          const Eigen::Vector3d x = p.cast<double>();
          const double range = x.norm();
          if (range >= least_range_m && range <= most_range_m) sums.add(x, cell_m);
        }
        parts[t] = sums.in_order();
      },
      1);
  return merged(std::move(parts));
}

std::vector<CellSums> with_double_cells(std::vector<CellSums> sums) {
  // Along the curve the parts of a larger cell follow one another. Half a cell's number, and a quarter of all cells
  // added to keep the origin in the middle, is a turn of the two highest bits of each axis that keeps the order.
  constexpr unsigned quarter = 57;  // bit 19 of x
  const auto key_of_double = [](std::uint64_t key) {
    const std::uint64_t half = key >> 3U;
    const std::uint64_t top = half >> quarter;
    return (half & ((std::uint64_t{1} << quarter) - 1)) | top << (quarter + 3) | (~top & 7U) << quarter;
  };
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const std::uint64_t key = key_of_double(sums[i].key);
    if (kept > 0 && sums[kept - 1].key == key) {
      sums[kept - 1] += sums[i];
    } else {
      sums[kept] = sums[i];
      sums[kept++].key = key;
    }
  }
  sums.resize(kept);
  return sums;
}

}  // namespace adit
