#include "core/simulation/ray_cast.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

using Nearness = RockTunnel::Nearness;
using People = std::vector<Eigen::Vector2d>;

/// A ray with where it was last seen in each tunnel.
class Ray {
 public:
  Ray(std::span<const RockTunnel> tunnels, std::span<const TunnelFrames> frames, const Eigen::Vector3d& origin,
      const Eigen::Vector3d& direction, const People& people)
      : tunnels_(tunnels), frames_(frames), origin_(origin), direction_(direction), people_(people) {
    for (const RockTunnel& tunnel : tunnels) {
      const auto start = tunnel.design().alignment().to_tunnel(origin);
      hints_.push_back(start ? start->s_m : tunnel.options().from_m);
    }
  }

  /// The way through the air may be a hundredth of a millimetre wrong ...
  std::optional<Nearness> roughly_at(double range_m) {
    return at([&](std::size_t i) { return frames_[i].to_tunnel(place(range_m), hints_[i]); });
  }
  /// ... the surface itself is met exactly.
  std::optional<Nearness> exactly_at(double range_m) {
    return at([&](std::size_t i) { return tunnels_[i].design().alignment().to_tunnel(place(range_m), hints_[i]); });
  }

 private:
  Eigen::Vector3d place(double range_m) const { return origin_ + range_m * direction_; }

  /// Nothing outside of all tunnels' lengths: the open end of the main one.
  template <typename ToTunnel>
  std::optional<Nearness> at(const ToTunnel& to_tunnel) {
    std::optional<Nearness> most;
    bool in_main = false;
    for (std::size_t i = 0; i < tunnels_.size(); ++i) {
      const std::optional<TunnelPoint> point = to_tunnel(i);
      if (!point || point->s_m < tunnels_[i].options().from_m) continue;
      hints_[i] = point->s_m;
      in_main = in_main || i == 0;
      const Nearness here = tunnels_[i].nearness(*point, i == 0 ? people_ : nobody_);
      if (!most || here.value_m > most->value_m) most = here;
    }
    if (!in_main && !(most && most->value_m > 0.0)) return std::nullopt;
    return most;
  }

  std::span<const RockTunnel> tunnels_;
  std::span<const TunnelFrames> frames_;
  Eigen::Vector3d origin_, direction_;
  const People& people_;
  const People nobody_;
  std::vector<double> hints_;
};

/// The surface between two ranges, one in the air and one behind it.
RayCast::Hit met_between(Ray& ray, double low, double high, Nearness in_air, Nearness behind) {
  double low_value = in_air.value_m;
  double high_value = behind.value_m;
  const double slope = (low_value - high_value) / (high - low);
  for (int i = 0; i < 40 && high - low > 1e-5; ++i) {
    // False position on even turns, halving on odd ones: fast on smooth rock, safe at the steps.
    const double share = i % 2 == 0 ? std::clamp(low_value / (low_value - high_value), 0.02, 0.98) : 0.5;
    const double middle = low + share * (high - low);
    const auto value = ray.exactly_at(middle);
    if (!value) break;
    (value->value_m > 0.0 ? low : high) = middle;
    (value->value_m > 0.0 ? low_value : high_value) = value->value_m;
    if (value->value_m <= 0.0) behind.surface = value->surface;
    if (std::abs(value->value_m) < 1e-5) {
      low = high = middle;
      break;
    }
  }
  return {0.5 * (low + high), std::clamp(slope, 0.02, 1.0), behind.surface};
}

}  // namespace

RayCast::RayCast(std::span<const RockTunnel> tunnels) : tunnels_(tunnels) {
  for (const RockTunnel& tunnel : tunnels)
    frames_.emplace_back(tunnel.design().alignment(), tunnel.options().from_m, tunnel.design().alignment().to_m());
}

std::optional<RayCast::Hit> RayCast::first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                               double most_range_m, const People& people) const {
  Ray ray(tunnels_, frames_, origin, direction, people);
  double range = 0.2;
  auto here = ray.roughly_at(range);
  if (!here || here->value_m <= 0.0) return std::nullopt;
  while (range <= most_range_m) {
    const double next_range = range + std::max(0.75 * here->value_m, 0.004);
    const auto next = ray.roughly_at(next_range);
    if (!next) return std::nullopt;
    if (next->value_m <= 0.0) {
      const Hit hit = met_between(ray, range, next_range, *here, *next);
      if (hit.range_m > most_range_m) return std::nullopt;
      return hit;
    }
    range = next_range;
    here = next;
  }
  return std::nullopt;
}

}  // namespace adit
