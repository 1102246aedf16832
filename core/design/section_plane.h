#pragma once
// The planes in which sections lie, profiles are drawn and deviations are measured.

#include <Eigen/Core>

#include "core/design/alignment.h"

namespace adit {

enum class SectionPlane {
  vertical,  ///< square to the plan tangent of the axis
  square,    ///< square to the axis in space
};

inline const char* words_of(SectionPlane plane) {
  return plane == SectionPlane::vertical ? "vertical, square to the axis in plan" : "square to the axis in space";
}

/// A place of vertical sections, as Alignment::to_tunnel gives it, in planes square to the axis in space: s is the
/// chainage of the plane through the point, x the offset in it, z the height along it, square to the axis. Exact to a
/// micrometre on every element; next to the ends of the axis the outermost plane answers.
TunnelPoint square_from_vertical(const Alignment& axis, const TunnelPoint& vertical);

/// And back: the place in space of a point of a square plane.
Eigen::Vector3d site_of_square(const Alignment& axis, const TunnelPoint& square);

/// What a slice ds of plan chainage holds: ds times (per_area A - per_x Mx - per_z Mz) of its polygons' areas and first
/// moments. With k the plan curvature (right positive), the grade's angle and its change t' over the chainage:
/// vertical 1, k, 0; square 1/cos, k cos, t'.
struct SliceShape {
  double per_area = 1.0;
  double per_x = 0.0;
  double per_z = 0.0;

  double of(double area_m2, double moment_x_m3, double moment_z_m3) const {
    return per_area * area_m2 - per_x * moment_x_m3 - per_z * moment_z_m3;
  }
  /// At one place: of a unit of area there.
  double at(const Eigen::Vector2d& place) const { return of(1.0, place.x(), place.y()); }
};
SliceShape slice_shape(const Alignment& axis, SectionPlane plane, double chainage_m);

}  // namespace adit
