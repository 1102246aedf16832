#pragma once
// Which of some values stand in the cells around a place?

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/cell_sums.h"

namespace adit {

/// Finds slots (0, 1, ...) by the keys of their cells. Queries may run on several threads at once.
class CellIndex {
 public:
  CellIndex() = default;
  /// keys[slot] is the cell (cell_key) of a slot; no two are alike.
  CellIndex(std::span<const std::uint64_t> keys, double cell_m);

  double cell_m() const { return cell_m_; }

  /// Calls visit(slot) for the cell that holds the place and the 26 around it, in a fixed order.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, const Visit& visit) const {
    const Eigen::Vector3d cell = (place / cell_m_).array().floor() + half_cells;
    if (table_.empty() || !(cell.minCoeff() >= 1.0 && cell.maxCoeff() < 2.0 * half_cells - 1.0)) return;
    const std::uint64_t key = cell_key(cell);
    for (const std::uint64_t step : neighbour_steps_)
      if (const std::uint32_t slot = slot_of(key + step); slot != none) visit(std::size_t{slot});
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  struct Entry {
    std::uint64_t key = ~std::uint64_t{0};
    std::uint32_t slot = none;
  };
  std::uint32_t slot_of(std::uint64_t key) const {
    for (std::uint64_t i = key * 0x9E3779B97F4A7C15ULL >> shift_;; ++i) {
      const Entry& entry = table_[i & (table_.size() - 1)];
      if (entry.slot == none || entry.key == key) return entry.slot;
    }
  }

  double cell_m_ = 1.0;
  std::vector<Entry> table_;  ///< open addressing, at most half full; its length is a power of two
  unsigned shift_ = 0;
  std::array<std::uint64_t, 27> neighbour_steps_{};
};

}  // namespace adit
