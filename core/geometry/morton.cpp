#include "core/geometry/morton.h"

#include <bit>

namespace adit {

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
