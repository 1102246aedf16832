#pragma once
// The circle and the ellipse that fit a ring of measured points best, in the ring's own plane.

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace adit {

/// A measured point: its place [m] and how far it stands inside the surface (a target's centre before the lining).
struct RingPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double target_offset_m = 0.0;
};

/// Residuals are outward positive: how far the surface lies outside the circle at each point.
struct RingFit {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();  ///< of the ring's plane, unit, either sense
  double radius_m = 0.0;                              ///< of the surface: target offsets are added
  double rms_m = 0.0;                                 ///< of the residuals
  double out_of_plane_m = 0.0;                        ///< root mean square distance of the points from the plane
  /// One sigma in the plane (the worse direction) and of the radius, from the residuals; not a number for three points,
  /// which leave none.
  double sigma_center_m = std::numeric_limits<double>::quiet_NaN();
  double sigma_radius_m = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> residuals_m;
  double covered_deg = 0.0;  ///< 360 less the greatest angle between two neighbouring points, seen from the centre
  /// The best ellipse; not a number for fewer than six points or where they cover less than 210 degrees. Ovality:
  /// largest less smallest diameter.
  double semi_major_m = std::numeric_limits<double>::quiet_NaN();
  double semi_minor_m = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d major_direction = Eigen::Vector3d::Zero();  ///< unit
  double ovality_m = std::numeric_limits<double>::quiet_NaN();
};

/// Least squares of the distances in the plane. The plane is the one that fits the points best; where they do not tell
/// one (three points, or points that spread as much across it as in it) it is square to `along`. Circle: Gauss-Newton
/// from Kasa's start. Ellipse: Gauss-Newton on the distances to it. Throws Error when there are fewer than three
/// points, they lie on one line, or the circle is larger than a kilometre.
RingFit fit_ring(const std::vector<RingPlace>& places, const Eigen::Vector3d& along);

}  // namespace adit
