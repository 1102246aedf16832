#pragma once
// One line or arc of a design line, prepared for fast nearest points.

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <vector>

namespace adit {

/// A line or an arc from start to end, (x, z) [m]. bulge = tan(sweep / 4), positive counter-clockwise in (x, z) with x
/// to the right and z up (the convention of DXF polylines); 0 is a line.
struct ProfileSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double bulge = 0.0;
};

/// A segment of a clockwise line, seen from its middle: `tangent` runs along the line there, `radial` points away from
/// the centre of an arc. Distances are taken from the middle, never from the centre, so that very flat arcs stay exact.
struct ProfilePiece {
  Eigen::Vector2d start, end, middle, tangent, radial;
  double half_length_m = 0.0;
  double radius_m = 0.0;  ///< 0 for a line
  double half_sweep_rad = 0.0;
  double sine_of_half_sweep = 0.0;
  double outward = 1.0;    ///< +1 when radial points out of the profile (convex), -1 for a hollow arc
  double first_p_m = 0.0;  ///< from the crown, in [0, length)

  explicit ProfilePiece(const ProfileSegment& segment);

  bool is_arc() const { return radius_m > 0.0; }
  double length_m() const { return 2.0 * half_length_m; }
  double curvature_per_m() const { return is_arc() ? outward / radius_m : 0.0; }

  /// Along is measured from the middle, [-half_length, half_length].
  Eigen::Vector2d position(double along_m) const;
  Eigen::Vector2d normal(double along_m) const;  ///< outward, unit
  Eigen::AlignedBox2d box() const;

  /// The part from one place to another as a segment.
  ProfileSegment part(double from_along_m, double to_along_m) const;

  enum class Where { start, inside, end };
  struct Near {
    double squared_distance;
    Where where;
  };
  Near nearest(const Eigen::Vector2d& point) const;

  /// Foot of a point whose nearest place is inside: signed distance, outside positive, and where it is.
  struct Foot {
    double deviation_m;
    double along_m;
  };
  Foot foot(const Eigen::Vector2d& point) const;

 private:
  double distance_from_circle(const Eigen::Vector2d& from_middle, double from_centre_m) const {
    return (from_middle.squaredNorm() + 2.0 * radius_m * from_middle.dot(radial)) / (from_centre_m + radius_m);
  }
};

/// Exact area inside a ring of lines and arcs, counter-clockwise positive [m2].
double signed_area_m2(const std::vector<ProfileSegment>& ring);

inline ProfilePiece::Near ProfilePiece::nearest(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d w = point - middle;
  const double along = w.dot(tangent);
  if (!is_arc()) {
    if (std::abs(along) <= half_length_m) {
      const double across = w.dot(radial);
      return {across * across, Where::inside};
    }
  } else {
    const double height = w.dot(radial) + radius_m;
    const double from_centre = std::sqrt(along * along + height * height);
    const bool in_sweep = half_sweep_rad <= 0.5 * std::numbers::pi
                              ? height > 0.0 && std::abs(along) <= from_centre * sine_of_half_sweep
                              : height >= 0.0 || std::abs(along) >= from_centre * sine_of_half_sweep;
    if (in_sweep) {
      const double distance = distance_from_circle(w, from_centre);
      return {distance * distance, Where::inside};
    }
  }
  if (along < 0.0) return {(point - start).squaredNorm(), Where::start};
  return {(point - end).squaredNorm(), Where::end};
}

inline ProfilePiece::Foot ProfilePiece::foot(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d w = point - middle;
  const double along = w.dot(tangent);
  if (!is_arc()) return {w.dot(radial), along};
  const double height = w.dot(radial) + radius_m;
  const double from_centre = std::sqrt(along * along + height * height);
  if (from_centre == 0.0) return {-outward * radius_m, 0.0};  // the centre: every place is as near
  return {outward * distance_from_circle(w, from_centre), radius_m * std::atan2(along, height)};
}

}  // namespace adit
