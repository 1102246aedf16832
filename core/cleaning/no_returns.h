#pragma once
// Pulses without an echo that a scanner wrote as points at its largest range.

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <map>

namespace adit {

/// Watches the ranges of a stream of points for a shell at the largest distance from the scanner (the frame's origin).
/// Memory: the distinct float32 ranges within 1 cm.
class NoReturnShell {
 public:
  void add(const Eigen::Vector3f& point) {
    ++points_;
    if (point.squaredNorm() >= squared_nearest_m2_) add_far(point.norm());
  }
  /// True when no point up to this range can belong to the shell any more: pass() will do for them.
  bool is_clear_of(double range_m) const { return range_m * range_m * (1.0 + 1e-6) < double{squared_nearest_m2_}; }
  /// So many points that the shell is clear of: they only count.
  void pass(std::uint64_t points) { points_ += points; }
  /// Points at this range or farther are pulses without an echo: those that share the largest range within 1 cm, when
  /// they are ten or more, over 0.3 % of all, and that range exceeds 10 m - no surface of a tunnel is a sphere about
  /// the scanner. Infinite when there is no such shell.
  float begins_at_m() const;
  /// How many points lie there.
  std::uint64_t count() const;

 private:
  void add_far(float range_m);

  std::map<float, std::uint64_t> farthest_;  ///< ranges within the shell below the largest, and how often each came
  float largest_m_ = 0.0F;
  float squared_nearest_m2_ = 0.0F;  ///< a little below where the shell begins: a sieve
  std::uint64_t points_ = 0;
};

}  // namespace adit
