#pragma once
// The only source of chance: numbers from a seed and an index, so that any loop may run in any order on any threads.

#include <cmath>
#include <cstdint>

#include "core/foundation/angle.h"

namespace adit {

/// A stream of random numbers addressed by index: the same (seed, stream, index) gives the same number on every
/// machine. Mixing after Steele et al., SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
      : key_(mix(seed ^ mix(stream + 0x9E3779B97F4A7C15ULL))) {}

  std::uint64_t bits(std::uint64_t index) const { return mix(key_ + index * 0x9E3779B97F4A7C15ULL); }

  /// Uniform in [0, 1).
  double uniform(std::uint64_t index) const { return static_cast<double>(bits(index) >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double uniform(std::uint64_t index, double low, double high) const { return low + (high - low) * uniform(index); }

  /// Standard normal (Box-Muller; uses its own two numbers per index).
  double normal(std::uint64_t index) const {
    const double u = 1.0 - static_cast<double>(bits(2 * index + 0x5851F42D4C957F2DULL) >> 11) * 0x1.0p-53;
    const double v = static_cast<double>(bits(2 * index + 0x5851F42D4C957F2EULL) >> 11) * 0x1.0p-53;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * pi * v);
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  std::uint64_t key_;
};

}  // namespace adit
