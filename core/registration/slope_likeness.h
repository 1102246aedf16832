#pragma once
// How alike two surfaces that lie on each other slope along the tunnel: what tells where along it a scan stands.

#include <Eigen/Core>

#include <algorithm>
#include <array>

#include "core/geometry/pose.h"
#include "core/registration/surface_map.h"

namespace adit {

/// Sums over pieces of the source that have some of the target near.
struct Slopes {
  double pieces = 0.0;
  double source = 0.0;  ///< of squared slopes
  double common = 0.0;  ///< of products of slopes, where the surfaces meet

  /// 1 for the same surface, about 0 for smooth walls and for rock elsewhere.
  double likeness() const { return common / std::max(source, 1e-9); }

  Slopes& operator+=(const Slopes& other);
  Slopes& operator-=(const Slopes& other);
};

/// The same, stretch by stretch along the axis.
struct SlopesAlong {
  static constexpr std::size_t count = 240;
  static constexpr double length_m = 0.5;  ///< of a stretch

  std::array<Slopes, count> stretches{};  ///< what is farther off is in the first and the last

  /// Where a stretch begins, along the axis from the target's origin.
  static double begin_m(std::size_t stretch);
  Slopes all() const;
  Slopes of(std::size_t first, std::size_t many) const;

  SlopesAlong& operator+=(const SlopesAlong& other);
};

/// Of at most `enough` pieces of the source, evenly taken. Slopes are along the axis (unit, target's frame); surfaces
/// near_m apart no longer meet.
SlopesAlong slopes_along(const SurfaceMap& target, const SurfaceMap& source, const Pose& target_from_source,
                         const Eigen::Vector3d& axis, double near_m, std::size_t enough);

/// Enough to tell two places apart.
inline constexpr std::size_t enough_slopes = 12000;
/// A likeness of less noise alone has as much.
inline constexpr double least_likeness = 0.03;

}  // namespace adit
