#pragma once
// Whole numbers of a few bits each, one behind the other.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace adit::io {

/// Bytes that hold `count` numbers of `width` bits.
constexpr std::size_t packed_bytes(std::size_t count, unsigned width) {
  return (count * width + 7) / 8;
}

/// Packs values, each below 2^width (0 to 32 bits), behind `bytes`.
inline void pack_bits(std::span<const std::uint32_t> values, unsigned width, std::vector<std::byte>& bytes) {
  if (width == 0) return;
  std::size_t at = bytes.size();
  bytes.resize(at + packed_bytes(values.size(), width));
  std::uint64_t waiting = 0;
  unsigned bits = 0;
  for (const std::uint32_t value : values) {
    waiting |= std::uint64_t{value} << bits;
    bits += width;
    if (bits < 32) continue;
    std::memcpy(bytes.data() + at, &waiting, 4);
    at += 4;
    waiting >>= 32;
    bits -= 32;
  }
  std::memcpy(bytes.data() + at, &waiting, (bits + 7) / 8);
}

/// Number i of those packed at `from`. Reads 8 bytes from the number's first one on: they must be there.
inline std::uint32_t packed_number(const std::byte* from, std::size_t i, unsigned width) {
  const std::size_t bit = i * width;
  std::uint64_t word = 0;
  std::memcpy(&word, from + bit / 8, 8);
  return static_cast<std::uint32_t>(word >> (bit % 8) & ((std::uint64_t{1} << width) - 1));
}

}  // namespace adit::io
