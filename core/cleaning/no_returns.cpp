#include "core/cleaning/no_returns.h"

#include <algorithm>

namespace adit {
namespace {

constexpr float shell_m = 0.01F;
constexpr float least_shell_range_m = 10.0F;
constexpr double least_share = 0.003;
constexpr std::uint64_t least_points = 10;

}  // namespace

void NoReturnShell::add_far(float range_m) {
  if (range_m > largest_m_) {
    largest_m_ = range_m;
    farthest_.erase(farthest_.begin(), farthest_.lower_bound(largest_m_ - shell_m));
    const float sieve_m = std::max(largest_m_ - 2.0F * shell_m, 0.0F);
    squared_nearest_m2_ = sieve_m * sieve_m;
  }
  if (range_m >= largest_m_ - shell_m && largest_m_ >= least_shell_range_m) ++farthest_[range_m];
}

std::uint64_t NoReturnShell::count() const {
  if (largest_m_ < least_shell_range_m) return 0;
  std::uint64_t count = 0;
  for (const auto& [range_m, times] : farthest_) count += times;
  const bool is_shell =
      count >= least_points && static_cast<double>(count) >= least_share * static_cast<double>(points_);
  return is_shell ? count : 0;
}

float NoReturnShell::begins_at_m() const {
  return count() == 0 ? std::numeric_limits<float>::infinity() : largest_m_ - shell_m;
}

}  // namespace adit
