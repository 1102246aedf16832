#include "core/design/alignment.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/foundation/error.h"

namespace adit {
namespace {

constexpr double end_tolerance_m = 1e-3;
constexpr double same_distance_m = 1e-3;
constexpr double widest_ramp_m = 60.0;  // turns of a ramp do not lie farther beside each other

}  // namespace

double Alignment::from_m() const {
  return vertical_.empty() ? horizontal_.from_m() : std::max(horizontal_.from_m(), vertical_.from_m());
}

double Alignment::to_m() const {
  return vertical_.empty() ? horizontal_.to_m() : std::min(horizontal_.to_m(), vertical_.to_m());
}

Eigen::Vector3d Alignment::to_site(const TunnelPoint& point) const {
  const Eigen::Vector2d plan = horizontal_.to_plan({point.s_m, point.x_m});
  return {plan.x(), plan.y(), vertical_.at(point.s_m).elevation_m + point.z_m};
}

std::optional<TunnelPoint> Alignment::to_tunnel(const Eigen::Vector3d& point, std::optional<double> hint_m) const {
  if (vertical_.empty()) throw Error("axis " + name_ + " has no grade line");
  const auto seen_from = [&](const PlanFoot& foot) -> std::optional<TunnelPoint> {
    if (foot.chainage_m < vertical_.from_m() - end_tolerance_m || foot.chainage_m > vertical_.to_m() + end_tolerance_m)
      return std::nullopt;
    return TunnelPoint{foot.chainage_m, foot.offset_m, point.z() - vertical_.at(foot.chainage_m).elevation_m};
  };
  if (hint_m) {
    const auto foot = horizontal_.foot(point.head<2>(), hint_m);
    return foot ? seen_from(*foot) : std::nullopt;
  }
  std::optional<TunnelPoint> best;
  double least = std::numeric_limits<double>::infinity();
  bool twice = false;
  for (const PlanFoot& foot : horizontal_.feet(point.head<2>(), widest_ramp_m)) {
    const auto at = seen_from(foot);
    if (!at) continue;
    const double distance = std::hypot(at->x_m, at->z_m);
    twice = std::abs(distance - least) < same_distance_m || (twice && distance > least);
    if (distance < least) best = at;
    least = std::min(least, distance);
  }
  return twice ? std::nullopt : best;
}

Alignment Alignment::relative_to(const Eigen::Vector3d& origin) const {
  return Alignment(name_, horizontal_.relative_to(origin.head<2>()), vertical_.relative_to(origin.z()), stations_,
                   cant_);
}

}  // namespace adit
