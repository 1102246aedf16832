#pragma once
// Horizontal and vertical axis together: chainage to point and point to chainage, offset, height.

#include <Eigen/Core>

#include <optional>
#include <string>

#include "core/design/horizontal_alignment.h"
#include "core/design/vertical_alignment.h"

namespace adit {

/// Tunnel coordinates of a point, vertical sections: chainage s, offset x right positive looking up-chainage, height z
/// above the grade line.
struct TunnelPoint {
  double s_m = 0.0;
  double x_m = 0.0;
  double z_m = 0.0;
};

/// One axis, immutable after reading. Coordinates are those of the frame it was made in: site, or site minus the
/// project origin after relative_to().
class Alignment {
 public:
  Alignment() = default;
  Alignment(std::string name, HorizontalAlignment horizontal, VerticalAlignment vertical)
      : name_(std::move(name)), horizontal_(std::move(horizontal)), vertical_(std::move(vertical)) {}

  const std::string& name() const { return name_; }
  const HorizontalAlignment& horizontal() const { return horizontal_; }
  const VerticalAlignment& vertical() const { return vertical_; }

  /// The chainages where both plan and grade are known; those of the plan when there is no grade line.
  double from_m() const;
  double to_m() const;

  /// Throws Error outside [from, to] (1 mm tolerance) and when there is no grade line.
  Eigen::Vector3d to_site(const TunnelPoint& point) const;
  /// Empty where the point has no foot on the axis within [from, to] (1 mm tolerance). The hint is that of
  /// HorizontalAlignment::foot. Throws Error when there is no grade line.
  std::optional<TunnelPoint> to_tunnel(const Eigen::Vector3d& point, std::optional<double> hint_m = std::nullopt) const;

  /// The same axis with `origin` (east, north, elevation) subtracted.
  Alignment relative_to(const Eigen::Vector3d& origin) const;

 private:
  std::string name_;
  HorizontalAlignment horizontal_;
  VerticalAlignment vertical_;
};

}  // namespace adit
