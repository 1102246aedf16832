#pragma once
// Horizontal and vertical axis together, with displayed stations and cant: chainage to point and point to chainage,
// offset, height.

#include <Eigen/Core>

#include <optional>
#include <string>

#include "core/design/cant.h"
#include "core/design/horizontal_alignment.h"
#include "core/design/station_equations.h"
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
  Alignment(std::string name, HorizontalAlignment horizontal, VerticalAlignment vertical,
            StationEquations stations = {}, Cant cant = {})
      : name_(std::move(name)),
        horizontal_(std::move(horizontal)),
        vertical_(std::move(vertical)),
        stations_(std::move(stations)),
        cant_(std::move(cant)) {}

  const std::string& name() const { return name_; }
  const HorizontalAlignment& horizontal() const { return horizontal_; }
  const VerticalAlignment& vertical() const { return vertical_; }
  const StationEquations& stations() const { return stations_; }
  const Cant& cant() const { return cant_; }

  /// The chainages where both plan and grade are known; those of the plan when there is no grade line.
  double from_m() const;
  double to_m() const;

  /// Throws Error outside [from, to] (1 mm tolerance) and when there is no grade line.
  Eigen::Vector3d to_site(const TunnelPoint& point) const;
  /// Empty where the point has no foot on the axis within [from, to] (1 mm tolerance). With a hint the foot is that of
  /// HorizontalAlignment::foot; without one it is the foot that is nearest in space, so that on ramps that lie above
  /// each other each point finds its own turn; empty when two feet are as near (1 mm). Throws Error when there is no
  /// grade line.
  std::optional<TunnelPoint> to_tunnel(const Eigen::Vector3d& point, std::optional<double> hint_m = std::nullopt) const;

  /// The same axis with `origin` (east, north, elevation) subtracted.
  Alignment relative_to(const Eigen::Vector3d& origin) const;

 private:
  std::string name_;
  HorizontalAlignment horizontal_;
  VerticalAlignment vertical_;
  StationEquations stations_;
  Cant cant_;
};

}  // namespace adit
