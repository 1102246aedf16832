#pragma once
// Which of some values stand in the cells around a place?

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/cell_sums.h"

namespace adit {

/// Finds slots (0, 1, ...) by their cells. Cells are kept in blocks of 4 x 4 x 4 with a bit for each: a place's 27
/// cells lie in one to eight blocks, so that few looks find all. Queries may run on several threads at once.
class CellIndex {
 public:
  CellIndex() = default;
  /// keys[slot] is the cell (cell_key) of a slot, in ascending order.
  CellIndex(std::span<const std::uint64_t> keys, double cell_m);

  double cell_m() const { return cell_m_; }

  /// Calls visit(slot) for the cell that holds the place and the 26 around it, in a fixed order.
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, const Visit& visit) const {
    const Eigen::Vector3d cells = in_cells(place, cell_m_);
    if (!is_numbered(cells.array() - 1.0) || !is_numbered(cells.array() + 1.0)) return;
    static constexpr Masks in_x = masks_along(0), in_y = masks_along(1), in_z = masks_along(2);
    const Reach x(cells.x()), y(cells.y()), z(cells.z());
    for (std::uint64_t k = z.first_block; k <= z.last_block; ++k)
      for (std::uint64_t j = y.first_block; j <= y.last_block; ++j)
        for (std::uint64_t i = x.first_block; i <= x.last_block; ++i) {
          const Block* block = block_at(i | j << 21U | k << 42U);
          if (block == nullptr) continue;
          const std::uint64_t wanted = in_x[x.within(i)] & in_y[y.within(j)] & in_z[z.within(k)];
          visit_block(*block, wanted, visit);
        }
  }

 private:
  struct Block {
    std::uint64_t place = ~std::uint64_t{0};
    std::uint64_t cells = 0;  ///< bits of those that are filled, along the curve
    std::uint32_t first = 0;  ///< slot of the first of them
  };

  /// The three cells about a place on one axis.
  struct Reach {
    explicit Reach(double in_cells)
        : cell(cell_number(in_cells)), first_block((cell - 1) >> 2U), last_block((cell + 1) >> 2U) {}
    /// Bits of the four cells of a block that are within reach.
    unsigned within(std::uint64_t block) const {
      const std::uint64_t first = std::max(cell - 1, 4 * block) & 3U;
      const std::uint64_t last = std::min(cell + 1, 4 * block + 3) & 3U;
      return (2U << last) - (1U << first);
    }
    std::uint64_t cell, first_block, last_block;
  };

  /// For any of the four places along an axis (x 0, y 1, z 2), by their bits: the cells of a block that stand there.
  using Masks = std::array<std::uint64_t, 16>;
  static constexpr Masks masks_along(unsigned axis) {
    Masks masks{};
    for (unsigned places = 0; places < 16; ++places)
      for (unsigned cell = 0; cell < 64; ++cell) {
        const unsigned place = (cell >> axis & 1U) | (cell >> (axis + 3) & 1U) << 1U;  // along the Morton curve
        if ((places >> place & 1U) != 0) masks[places] |= std::uint64_t{1} << cell;
      }
    return masks;
  }

  template <typename Visit>
  static void visit_block(const Block& block, std::uint64_t wanted, const Visit& visit) {
    for (std::uint64_t found = block.cells & wanted; found != 0; found &= found - 1) {
      const std::uint64_t before = block.cells & ((found & -found) - 1);
      visit(std::size_t{block.first} + static_cast<std::size_t>(std::popcount(before)));
    }
  }

  const Block* block_at(std::uint64_t place) const {
    for (std::uint64_t i = slot_of(place); i < table_.size(); i = (i + 1) & (table_.size() - 1)) {
      if (table_[i].place == place) return &table_[i];
      if (table_[i].cells == 0) return nullptr;
    }
    return nullptr;
  }
  std::uint64_t slot_of(std::uint64_t place) const { return place * 0x9E3779B97F4A7C15ULL >> shift_; }

  double cell_m_ = 1.0;
  std::vector<Block> table_;  ///< open addressing, at most half full; its length is a power of two
  unsigned shift_ = 0;
};

}  // namespace adit
