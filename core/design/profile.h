#pragma once
// The design line in the section plane: a closed curve of lines and arcs.

#include <Eigen/Geometry>

#include <string>
#include <vector>

#include "core/geometry/polygon.h"

namespace adit {

/// A line or an arc from start to end, (x, z) [m]. bulge = tan(sweep / 4), positive counter-clockwise in (x, z) with x
/// to the right and z up (the convention of DXF polylines); 0 is a line.
struct ProfileSegment {
  Eigen::Vector2d start = Eigen::Vector2d::Zero();
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double bulge = 0.0;
};

/// A point of the design line.
struct ProfilePoint {
  double p_m = 0.0;                                     ///< arc length from the crown, clockwise looking up-chainage
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();    ///< outward, unit
  double curvature_per_m = 0.0;                         ///< positive where the line is convex (arch), 0 on lines
};

/// Nearest point of the design line to a point of the section.
struct ProfileFoot {
  double p_m = 0.0;
  double deviation_m = 0.0;                             ///< signed distance, outside positive (overbreak)
  Eigen::Vector2d direction = Eigen::Vector2d::UnitY(); ///< unit, outward: position = foot + deviation * direction
  int corner = -1;                                      ///< index into corners() when the foot is a corner, else -1
};

/// A place where the tangent jumps. turn_rad is positive where the line is convex: the wedge outside it between the two
/// normals has the corner as its nearest point.
struct ProfileCorner {
  double p_m = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal_before = Eigen::Vector2d::UnitY();
  Eigen::Vector2d normal_after = Eigen::Vector2d::UnitY();
  double turn_rad = 0.0;
};

/// Immutable closed curve, stored clockwise looking up-chainage (x right, z up), starting at the crown: the highest
/// point, the one nearest to x = 0 when several are as high. p runs over [-length/2, length/2): negative on the left.
class Profile {
 public:
  Profile() = default;
  /// Throws Error when the segments do not join (1 mm), do not close, cross themselves, have no inside or are not
  /// finite; the message names the segment and the place.
  Profile(std::string name, std::vector<ProfileSegment> segments);

  const std::string& name() const { return name_; }
  const std::vector<ProfileSegment>& segments() const { return segments_; }
  const std::vector<ProfileCorner>& corners() const { return corners_; }
  double length_m() const { return length_m_; }
  double area_m2() const { return area_m2_; }
  Eigen::AlignedBox2d box() const { return box_; }

  /// p in [-length/2, length/2).
  double wrapped_p(double p_m) const;
  ProfilePoint at(double p_m) const;
  ProfileFoot nearest(const Eigen::Vector2d& point) const;
  bool contains(const Eigen::Vector2d& point) const;

  /// Ring of points on the line, clockwise from the crown, arcs within the tolerance.
  Polygon flattened(double tolerance_m = 1e-5) const;

 private:
  struct Piece;  // a segment with its centre, radius, angles and first p
  std::string name_;
  std::vector<ProfileSegment> segments_;
  std::vector<ProfileCorner> corners_;
  std::vector<double> first_p_m_;  ///< of each segment, from the crown, in [0, length)
  double length_m_ = 0.0;
  double area_m2_ = 0.0;
  Eigen::AlignedBox2d box_;
};

}  // namespace adit
