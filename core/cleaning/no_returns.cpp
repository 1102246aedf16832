#include "core/cleaning/no_returns.h"

#include <algorithm>
#include <vector>

namespace adit {

std::size_t remove_no_returns(PointCloud& cloud) {
  constexpr float shell_m = 0.01F;
  constexpr float least_shell_range_m = 10.0F;
  float farthest = 0.0F;
  for (const auto& p : cloud.points) farthest = std::max(farthest, p.norm());
  if (farthest < least_shell_range_m) return 0;
  std::vector<std::size_t> kept;
  kept.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (cloud.points[i].norm() < farthest - shell_m) kept.push_back(i);
  const std::size_t removed = cloud.size() - kept.size();
  if (static_cast<double>(removed) < 0.003 * static_cast<double>(cloud.size())) return 0;
  cloud = selected(cloud, kept);
  return removed;
}

}  // namespace adit
