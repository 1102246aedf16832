#include "io/stored_points.h"

#include <algorithm>

namespace adit::io {
namespace {

constexpr int steps_a_cell_bits = 5;  // 32 steps of 0.1 mm
constexpr double cells_a_metre = 312.5;
// Scans reach some 100 m: with this much added their cells need 16 bits an axis, and the sort fewer passes.
constexpr std::int64_t middle = std::int64_t{1} << 15;
constexpr std::int64_t farthest = (std::int64_t{1} << 20) - 1;

std::uint64_t cell_of(std::int32_t stored, Keep keep) {
  const std::int64_t cell =
      keep == Keep::float32
          ? static_cast<std::int64_t>(std::floor(static_cast<double>(std::bit_cast<float>(stored)) * cells_a_metre))
          : stored >> steps_a_cell_bits;
  return static_cast<std::uint64_t>(std::clamp(cell, -farthest, farthest) + middle) & 0x1FFFFF;
}

template <typename T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<KeyedIndex>& order) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (const KeyedIndex& item : order) result.push_back(values[item.index]);
  return result;
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

void CurveSorter::put_equal_keys_in_order(const StoredPoints& points) {
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  for (std::size_t begin = 0; begin < items_.size();) {
    std::size_t end = begin + 1;
    while (end < items_.size() && items_[end].key == items_[begin].key) ++end;
    if (end - begin > 1)
      std::sort(at(begin), at(end), [&](const KeyedIndex& a, const KeyedIndex& b) {
        return comes_before(points, a.index, a.key, points, b.index, b.key);
      });
    begin = end;
  }
}

StoredPoints CurveSorter::sorted(const StoredPoints& points, Keep keep) {
  items_.resize(points.size());
  for (std::size_t i = 0; i < items_.size(); ++i)
    items_[i] = {curve_key(points.positions[i], keep), static_cast<std::uint32_t>(i)};
  sort_by_key(items_, scratch_);
  put_equal_keys_in_order(points);
  return {in_order(points.positions, items_), in_order(points.intensity, items_), in_order(points.colour, items_)};
}

}  // namespace adit::io
