#pragma once
// Order along a space-filling (Morton, Z-order) curve: neighbours in the order are neighbours in space.

#include <array>
#include <cstdint>
#include <vector>

namespace adit {

/// Spreads the low 21 bits of a number to every third bit.
constexpr std::uint64_t every_third_bit(std::uint64_t x) {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x1F00000000FFFFULL;
  x = (x | x << 16) & 0x1F0000FF0000FFULL;
  x = (x | x << 8) & 0x100F00F00F00F00FULL;
  x = (x | x << 4) & 0x10C30C30C30C30C3ULL;
  x = (x | x << 2) & 0x1249249249249249ULL;
  return x;
}

inline constexpr auto thirds_of_11_bits = [] {
  std::array<std::uint64_t, 2048> table{};
  for (std::uint64_t i = 0; i < table.size(); ++i) table[i] = every_third_bit(i);
  return table;
}();

/// every_third_bit by two looks into the table.
inline std::uint64_t spread_21_bits(std::uint64_t x) {
  return thirds_of_11_bits[x & 2047] | thirds_of_11_bits[x >> 11 & 1023] << 33;
}

/// Key of a cell by its low 21 bits an axis.
inline std::uint64_t morton_key(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return spread_21_bits(x) | spread_21_bits(y) << 1 | spread_21_bits(z) << 2;
}

struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Positions 0 .. n-1 in bit-reversed order: every prefix is spread evenly over the whole.
std::vector<std::uint32_t> even_prefix_order(std::uint32_t n);

}  // namespace adit
