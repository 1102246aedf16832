#pragma once
// Rays through simulated tunnels.

#include <optional>
#include <span>
#include <vector>

#include "core/profiling/tunnel_frames.h"
#include "core/simulation/rock_tunnel.h"

namespace adit {

/// Casts rays in one tunnel, or in several that open into each other: air is where any of them has air. The first is
/// the main one; the others are its branches and niches, which begin inside it. Made once for many rays; the tunnels
/// must outlive it. Rays may be cast on several threads at once.
class RayCast {
 public:
  explicit RayCast(std::span<const RockTunnel> tunnels);
  explicit RayCast(const RockTunnel& tunnel) : RayCast(std::span(&tunnel, 1)) {}

  struct Hit {
    double range_m = 0.0;
    double incidence_cosine = 0.0;
    Surface surface = Surface::rock;
  };
  /// First surface along a ray, or nothing within the range or out of an open end. people: where persons stand,
  /// (s, x) of the main tunnel.
  std::optional<Hit> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double most_range_m,
                               const std::vector<Eigen::Vector2d>& people) const;

 private:
  std::span<const RockTunnel> tunnels_;
  std::vector<TunnelFrames> frames_;
};

}  // namespace adit
