#include "core/geometry/morton.h"

#include <array>
#include <bit>
#include <cstddef>

namespace adit {
namespace {

constexpr unsigned most_digit_bits = 11;

/// One pass: from -> to, in the order of the `width` bits at `shift`.
void sort_by_digit(const std::vector<KeyedIndex>& from, std::vector<KeyedIndex>& to, unsigned shift, unsigned width) {
  std::array<std::size_t, std::size_t{1} << most_digit_bits> place{};
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  for (const KeyedIndex& item : from) ++place[item.key >> shift & mask];
  std::size_t sum = 0;
  for (std::size_t& count : place) {
    const std::size_t mine = count;
    count = sum;
    sum += mine;
  }
  for (const KeyedIndex& item : from) to[place[item.key >> shift & mask]++] = item;
}

}  // namespace

void sort_by_key(std::vector<KeyedIndex>& items, std::vector<KeyedIndex>& scratch) {
  if (items.size() < 2) return;
  std::uint64_t differing = 0;
  for (const KeyedIndex& item : items) differing |= item.key ^ items.front().key;
  if (differing == 0) return;
  scratch.resize(items.size());
  unsigned shift = static_cast<unsigned>(std::countr_zero(differing));
  const unsigned bits = static_cast<unsigned>(std::bit_width(differing)) - shift;
  const unsigned passes = (bits + most_digit_bits - 1) / most_digit_bits;
  const unsigned width = (bits + passes - 1) / passes;
  for (unsigned pass = 0; pass < passes; ++pass, shift += width) {
    sort_by_digit(items, scratch, shift, width);
    items.swap(scratch);
  }
}

std::vector<std::uint32_t> even_prefix_order(std::uint32_t n) {
  std::vector<std::uint32_t> order;
  order.reserve(n);
  const std::uint64_t end = std::bit_ceil(std::uint64_t{n});
  std::uint64_t reversed = 0;
  for (std::uint64_t i = 0; i < end; ++i) {
    if (reversed < n) order.push_back(static_cast<std::uint32_t>(reversed));
    // Counting in bit-reversed order: the carry runs from the highest bit down.
    std::uint64_t bit = end >> 1;
    while ((reversed & bit) != 0) {
      reversed ^= bit;
      bit >>= 1;
    }
    reversed |= bit;
  }
  return order;
}

}  // namespace adit
