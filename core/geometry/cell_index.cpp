#include "core/geometry/cell_index.h"

#include <bit>

namespace adit {

CellIndex::CellIndex(std::span<const std::uint64_t> keys, double cell_m) : cell_m_(cell_m) {
  const unsigned bits = static_cast<unsigned>(std::bit_width(2 * keys.size() + 1));
  table_.resize(std::size_t{1} << bits);
  shift_ = 64 - bits;
  for (std::size_t slot = 0; slot < keys.size(); ++slot) {
    std::uint64_t place = keys[slot] * 0x9E3779B97F4A7C15ULL >> shift_;
    while (table_[place & (table_.size() - 1)].slot != none) ++place;
    table_[place & (table_.size() - 1)] = {keys[slot], static_cast<std::uint32_t>(slot)};
  }
  std::size_t n = 0;
  for (const std::uint64_t z : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
    for (const std::uint64_t y : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
      for (const std::uint64_t x : {~std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{1}})
        neighbour_steps_[n++] = x + (y << 21U) + (z << 42U);
}

}  // namespace adit
