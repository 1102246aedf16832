#include "core/geometry/morton.h"

#include <array>
#include <bit>
#include <cstddef>

namespace adit {
namespace {

constexpr unsigned digit_bits = 11;
constexpr std::size_t digits = std::size_t{1} << digit_bits;

/// One pass: from -> to, in the order of the digit at `shift`.
void sort_by_digit(const std::vector<KeyedIndex>& from, std::vector<KeyedIndex>& to, unsigned shift) {
  std::array<std::size_t, digits> place{};
  for (const KeyedIndex& item : from) ++place[item.key >> shift & (digits - 1)];
  std::size_t sum = 0;
  for (std::size_t& count : place) {
    const std::size_t mine = count;
    count = sum;
    sum += mine;
  }
  for (const KeyedIndex& item : from) to[place[item.key >> shift & (digits - 1)]++] = item;
}

}  // namespace

void sort_by_key(std::vector<KeyedIndex>& items) {
  if (items.size() < 2) return;
  std::uint64_t differing = 0;
  for (const KeyedIndex& item : items) differing |= item.key ^ items.front().key;
  std::vector<KeyedIndex> other(items.size());
  while (differing != 0) {
    const auto shift = static_cast<unsigned>(std::countr_zero(differing));
    sort_by_digit(items, other, shift);
    items.swap(other);
    differing = shift + digit_bits < 64 ? differing >> (shift + digit_bits) << (shift + digit_bits) : 0;
  }
}

std::vector<std::uint32_t> even_prefix_order(std::uint32_t n) {
  std::vector<std::uint32_t> order;
  order.reserve(n);
  unsigned bits = 0;
  while ((std::uint64_t{1} << bits) < n) ++bits;
  for (std::uint64_t i = 0; i < (std::uint64_t{1} << bits); ++i) {
    std::uint64_t reversed = 0;
    for (unsigned b = 0; b < bits; ++b) reversed |= (i >> b & 1U) << (bits - 1 - b);
    if (reversed < n) order.push_back(static_cast<std::uint32_t>(reversed));
  }
  return order;
}

}  // namespace adit
