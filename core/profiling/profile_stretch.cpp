#include <algorithm>
#include <cmath>

#include "core/profiling/deviation_map.h"

namespace adit {

ProfileStretch::ProfileStretch(const Profile& profile, double wedge_m) : profile_(profile) {
  const auto& corners = profile_.corners();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (corners[i].turn_rad > 0.0) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corners[a].p_m < corners[b].p_m; });
  wedge_of_corner_.assign(corners.size(), -1);
  double widths = 0.0;
  for (const std::size_t i : order) {
    const double begin = corners[i].p_m + 0.5 * profile_.length_m() + widths;
    const double width = wedge_m * corners[i].turn_rad;
    wedge_of_corner_[i] = static_cast<int>(wedges_.size());
    wedges_.push_back({begin, begin + width, corners[i]});
    widths += width;
  }
  length_m_ = profile_.length_m() + widths;
}

double ProfileStretch::q_of(const ProfileFoot& foot) const {
  if (foot.corner >= 0) {
    const int wedge = wedge_of_corner_[static_cast<std::size_t>(foot.corner)];
    if (wedge >= 0) {
      const Wedge& w = wedges_[static_cast<std::size_t>(wedge)];
      const double angle = std::acos(std::clamp(w.corner.normal_before.dot(foot.direction), -1.0, 1.0));
      return w.q_begin_m + (w.q_end_m - w.q_begin_m) * std::clamp(angle / w.corner.turn_rad, 0.0, 1.0);
    }
  }
  double q = foot.p_m + 0.5 * profile_.length_m();
  for (const Wedge& wedge : wedges_)
    if (foot.p_m > wedge.corner.p_m) q += wedge.q_end_m - wedge.q_begin_m;
  return std::clamp(q, 0.0, length_m_);
}

ProfilePoint ProfileStretch::at(double q_m) const {
  double widths = 0.0;
  for (const Wedge& wedge : wedges_) {
    if (q_m < wedge.q_begin_m) break;
    if (q_m <= wedge.q_end_m) {
      // Looking up-chainage the line runs clockwise, so its normals turn clockwise, too.
      const double angle = -wedge.corner.turn_rad * (q_m - wedge.q_begin_m) / (wedge.q_end_m - wedge.q_begin_m);
      const Eigen::Vector2d& n = wedge.corner.normal_before;
      ProfilePoint point;
      point.p_m = wedge.corner.p_m;
      point.position = wedge.corner.position;
      point.normal = {std::cos(angle) * n.x() - std::sin(angle) * n.y(),
                      std::sin(angle) * n.x() + std::cos(angle) * n.y()};
      return point;
    }
    widths += wedge.q_end_m - wedge.q_begin_m;
  }
  return profile_.at(q_m - widths - 0.5 * profile_.length_m());
}

double ProfileStretch::line_length_m(double first_q_m, double last_q_m) const {
  double length = last_q_m - first_q_m;
  for (const Wedge& wedge : wedges_)
    length -= std::max(0.0, std::min(last_q_m, wedge.q_end_m) - std::max(first_q_m, wedge.q_begin_m));
  return std::max(length, 0.0);
}

std::size_t ProfileStretch::columns(double step_q_m) const {
  return static_cast<std::size_t>(std::ceil(length_m_ / step_q_m - 1e-9));
}

}  // namespace adit
