#include "io/stored_points.h"

#include <algorithm>

#include "core/geometry/morton.h"

namespace adit::io {
namespace {

constexpr std::int32_t steps_a_cell = 40;
constexpr double cells_a_metre = 250.0;
// Scans reach some 100 m: with this much added their cells need 16 bits an axis, and the sort fewer passes.
constexpr std::int64_t middle = std::int64_t{1} << 15;
constexpr std::int64_t farthest = (std::int64_t{1} << 20) - 1;

std::uint64_t cell_of(std::int32_t stored, Keep keep) {
  std::int64_t cell = 0;
  if (keep == Keep::float32)
    cell = static_cast<std::int64_t>(std::floor(static_cast<double>(std::bit_cast<float>(stored)) * cells_a_metre));
  else
    cell = stored / steps_a_cell - (stored % steps_a_cell < 0 ? 1 : 0);
  return static_cast<std::uint64_t>(std::clamp(cell, -farthest, farthest) + middle) & 0x1FFFFF;
}

}  // namespace

std::uint64_t curve_key(const StoredPosition& stored, Keep keep) {
  return morton_key(cell_of(stored[0], keep), cell_of(stored[1], keep), cell_of(stored[2], keep));
}

bool comes_before(const StoredPoints& a, std::size_t i, std::uint64_t key_a, const StoredPoints& b, std::size_t k,
                  std::uint64_t key_b) {
  if (key_a != key_b) return key_a < key_b;
  if (a.positions[i] != b.positions[k]) return a.positions[i] < b.positions[k];
  if (!a.intensity.empty() && a.intensity[i] != b.intensity[k]) return a.intensity[i] < b.intensity[k];
  return !a.colour.empty() && a.colour[i] < b.colour[k];
}

std::vector<std::uint32_t> curve_order(const StoredPoints& points, Keep keep) {
  std::vector<KeyedIndex> items(points.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    items[i] = {curve_key(points.positions[i], keep), static_cast<std::uint32_t>(i)};
  sort_by_key(items);
  for (std::size_t begin = 0; begin < items.size();) {
    std::size_t end = begin + 1;
    while (end < items.size() && items[end].key == items[begin].key) ++end;
    if (end - begin > 1)
      std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin), items.begin() + static_cast<std::ptrdiff_t>(end),
                [&](const KeyedIndex& a, const KeyedIndex& b) {
                  return comes_before(points, a.index, a.key, points, b.index, b.key);
                });
    begin = end;
  }
  std::vector<std::uint32_t> order(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) order[i] = items[i].index;
  return order;
}

}  // namespace adit::io
