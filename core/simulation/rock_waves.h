#pragma once
// Band-limited roughness: a sum of random plane waves over (s, p), periodic in p.

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"

namespace adit {

class RockWaves {
 public:
  /// Waves of lengths between shortest and longest [m] over a line of given length; standard deviation 1.
  RockWaves(std::uint64_t seed, std::uint64_t stream, double shortest_m, double longest_m, double line_length_m) {
    const Random random(seed, stream);
    constexpr int count = 48;
    for (std::uint64_t i = 0; waves_.size() < count && i < 100000; ++i) {
      const double length = shortest_m * std::pow(longest_m / shortest_m, random.uniform(4 * i));
      const double angle = random.uniform(4 * i + 1, 0.0, pi);
      const double turns = std::round(line_length_m * std::sin(angle) / length);
      const double kp = 2.0 * pi * turns / line_length_m;
      const double k = 2.0 * pi / length;
      if (std::abs(kp) >= k) continue;
      const double ks = std::copysign(std::sqrt(k * k - kp * kp), std::cos(angle));
      waves_.push_back({ks, kp, random.uniform(4 * i + 2, 0.0, 2.0 * pi)});
    }
  }

  double at(double s_m, double p_m) const {
    double sum = 0.0;
    for (const Wave& wave : waves_) sum += std::sin(wave.ks * s_m + wave.kp * p_m + wave.phase_rad);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  struct Wave {
    double ks;
    double kp;
    double phase_rad;
  };
  std::vector<Wave> waves_;
};

}  // namespace adit
