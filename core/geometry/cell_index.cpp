#include "core/geometry/cell_index.h"

namespace adit {
namespace {

/// Every third bit of a number, from the lowest: what morton_key has spread.
std::uint64_t gathered(std::uint64_t key) {
  std::uint64_t x = 0;
  for (unsigned bit = 0; bit < 21; ++bit) x |= (key >> 3U * bit & 1U) << bit;
  return x;
}

}  // namespace

CellIndex::CellIndex(std::span<const std::uint64_t> keys, double cell_m) : cell_m_(cell_m) {
  std::vector<Block> blocks;
  for (std::size_t slot = 0; slot < keys.size(); ++slot) {
    const std::uint64_t block = keys[slot] >> 6U;
    if (slot == 0 || keys[slot - 1] >> 6U != block)
      blocks.push_back({gathered(block) | gathered(block >> 1U) << 21U | gathered(block >> 2U) << 42U, 0,
                        static_cast<std::uint32_t>(slot)});
    blocks.back().cells |= std::uint64_t{1} << (keys[slot] & 63U);
  }
  const auto bits = static_cast<unsigned>(std::bit_width(2 * blocks.size() + 1));
  table_.resize(std::size_t{1} << bits);
  shift_ = 64 - bits;
  for (const Block& block : blocks) {
    std::uint64_t i = slot_of(block.place);
    while (table_[i].cells != 0) i = (i + 1) & (table_.size() - 1);
    table_[i] = block;
  }
}

}  // namespace adit
