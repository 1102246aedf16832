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

  /// Sines and cosines of all waves at one s or one p; a grid needs few of them and many sums.
  struct Phases {
    std::vector<double> sine;
    std::vector<double> cosine;
  };
  Phases phases_at_s(double s_m) const {
    return phases([&](const Wave& wave) { return wave.ks * s_m + wave.phase_rad; });
  }
  Phases phases_at_p(double p_m) const {
    return phases([&](const Wave& wave) { return wave.kp * p_m; });
  }
  double at(const Phases& s, const Phases& p) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < waves_.size(); ++i) sum += s.sine[i] * p.cosine[i] + s.cosine[i] * p.sine[i];
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }
  double at(double s_m, double p_m) const { return at(phases_at_s(s_m), phases_at_p(p_m)); }

 private:
  struct Wave {
    double ks;
    double kp;
    double phase_rad;
  };

  template <typename Angle>
  Phases phases(const Angle& angle) const {
    Phases result;
    for (const Wave& wave : waves_) {
      result.sine.push_back(std::sin(angle(wave)));
      result.cosine.push_back(std::cos(angle(wave)));
    }
    return result;
  }

  std::vector<Wave> waves_;
};

}  // namespace adit
