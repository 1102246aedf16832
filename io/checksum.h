#pragma once
// A fast 64-bit checksum against damage (not against intent).

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace adit::io {

/// Four lanes of 64-bit words, each word mixed in by xor, an odd factor and a turn. All three can be undone, so one
/// changed word always changes the sum.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes) {
    std::size_t i = 0;
    for (; i + 32 <= bytes.size(); i += 32)
      for (std::size_t lane = 0; lane < 4; ++lane) mix(lane, word(bytes.data() + i + 8 * lane, 8));
    for (std::size_t lane = 0; i < bytes.size(); i += 8, ++lane)
      mix(lane, word(bytes.data() + i, bytes.size() - i < 8 ? bytes.size() - i : 8));
    total_ += bytes.size();
  }
  std::uint64_t value() const {
    std::uint64_t sum = total_;
    for (const std::uint64_t lane : lanes_) sum = std::rotl((sum ^ lane) * factor, 29);
    return sum ^ sum >> 32;
  }

 private:
  static constexpr std::uint64_t factor = 0x9FB21C651E98DF25ULL;  // odd, with bits all over

  static std::uint64_t word(const std::byte* from, std::size_t size) {
    std::uint64_t value = 0;
    std::memcpy(&value, from, size);
    return value;
  }
  void mix(std::size_t lane, std::uint64_t value) { lanes_[lane] = std::rotl((lanes_[lane] ^ value) * factor, 31); }

  std::uint64_t lanes_[4] = {1, 2, 3, 4};
  std::uint64_t total_ = 0;
};

}  // namespace adit::io
