#include "core/simulation/truth.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

/// Depth inside the line, `wanted` at the most, to which points still have their foot at this place.
double own_depth(const Profile& profile, const ProfilePoint& point, double wanted) {
  double low = 0.0;
  double high = wanted;
  const auto own = [&](double depth) {
    const ProfileFoot foot = profile.nearest(point.position - depth * point.normal);
    return std::abs(foot.deviation_m + depth) < 1e-9;
  };
  if (own(high)) return high;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (own(middle) ? low : high) = middle;
  }
  return low;
}

void add_over(TrueSection& section, const ProfilePoint& at, double d, double dp) {
  const double x = at.position.x(), nx = at.normal.x(), k = at.curvature_per_m;
  section.overbreak_m2 += dp * (d + k * d * d / 2.0);
  section.overbreak_moment_m3 += dp * (x * d + (x * k + nx) * d * d / 2.0 + nx * k * d * d * d / 3.0);
}

void add_under(TrueSection& section, const ProfilePoint& at, double depth, double dp) {
  const double x = at.position.x(), nx = at.normal.x(), k = at.curvature_per_m;
  section.underbreak_m2 += dp * (depth - k * depth * depth / 2.0);
  section.underbreak_moment_m3 +=
      dp * (x * depth - (x * k + nx) * depth * depth / 2.0 + nx * k * depth * depth * depth / 3.0);
}

void add_wedge(TrueSection& section, const ProfileCorner& corner, double d) {
  if (corner.turn_rad <= 0.0 || d <= 0.0) return;
  const Eigen::Vector2d towards =
      (corner.normal_after - corner.normal_before * corner.normal_before.dot(corner.normal_after)).normalized();
  const double nx_integral =
      std::sin(corner.turn_rad) * corner.normal_before.x() + (1.0 - std::cos(corner.turn_rad)) * towards.x();
  section.overbreak_m2 += corner.turn_rad * d * d / 2.0;
  section.overbreak_moment_m3 += corner.position.x() * corner.turn_rad * d * d / 2.0 + nx_integral * d * d * d / 3.0;
}

}  // namespace

TrueSection true_section(const RockTunnel& tunnel, double chainage_m) {
  const Profile& profile = tunnel.profile();
  TrueSection section;
  section.chainage_m = chainage_m;
  section.design_area_m2 = profile.area_m2();
  // Steps end at the corners, so that no piece lies on two sides of one.
  std::vector<double> ends{-0.5 * profile.length_m(), 0.5 * profile.length_m()};
  for (const auto& corner : profile.corners()) ends.push_back(corner.p_m);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const auto steps = static_cast<std::size_t>(std::ceil((ends[i + 1] - ends[i]) / 0.01));
    if (steps == 0) continue;
    const double dp = (ends[i + 1] - ends[i]) / static_cast<double>(steps);
    for (std::size_t k = 0; k < steps; ++k) {
      const ProfilePoint at = profile.at(ends[i] + (static_cast<double>(k) + 0.5) * dp);
      const double d = tunnel.deviation(chainage_m, at.p_m);
      if (d > 0.0)
        add_over(section, at, d, dp);
      else if (d < 0.0)
        add_under(section, at, own_depth(profile, at, -d), dp);
    }
  }
  for (const auto& corner : profile.corners()) add_wedge(section, corner, tunnel.deviation(chainage_m, corner.p_m));
  section.area_m2 = section.design_area_m2 + section.overbreak_m2 - section.underbreak_m2;
  return section;
}

VolumeAmounts true_volume(const RockTunnel& tunnel, double from_m, double to_m, Progress& progress) {
  const auto steps = static_cast<std::size_t>(std::max(1.0, std::round((to_m - from_m) / 0.02)));
  const double ds = (to_m - from_m) / static_cast<double>(steps);
  const Profile& profile = tunnel.profile();
  const double design_moment = [&] {
    const AreaMoment whole = area_moment(profile.flattened());
    return whole.moment_m3 * (whole.area_m2 < 0.0 ? -1.0 : 1.0);
  }();
  using Sums = Eigen::Vector3d;  // over, under, design
  const Sums sums = parallel_ordered_sum(steps, 16, Sums(Sums::Zero()), [&](std::size_t begin, std::size_t end) {
    progress.step(begin, steps);
    Sums part = Sums::Zero();
    for (std::size_t i = begin; i < end; ++i) {
      const double s = from_m + (static_cast<double>(i) + 0.5) * ds;
      const double k = tunnel.design().alignment().horizontal().at(s).curvature_per_m;
      const TrueSection section = true_section(tunnel, s);
      part += ds * Sums(section.overbreak_m2 - k * section.overbreak_moment_m3,
                        section.underbreak_m2 - k * section.underbreak_moment_m3,
                        section.design_area_m2 - k * design_moment);
    }
    return part;
  });
  return {sums[2], sums[2] + sums[0] - sums[1], sums[0], sums[1]};
}

double true_face_chainage(const RockTunnel& tunnel) {
  const auto box = tunnel.profile().box();
  double sum = 0.0;
  std::size_t count = 0;
  for (double x = box.min().x() + 0.05; x < box.max().x(); x += 0.1)
    for (double z = box.min().y() + 0.05; z < box.max().y(); z += 0.1)
      if (tunnel.profile().contains({x, z})) {
        sum += tunnel.face_chainage(x, z);
        ++count;
      }
  return sum / static_cast<double>(std::max<std::size_t>(count, 1));
}

}  // namespace adit
