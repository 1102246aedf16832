#pragma once
// The design line in the section plane: a closed curve of lines and arcs.

#include <Eigen/Geometry>

#include <string>
#include <vector>

#include "core/design/profile_piece.h"
#include "core/geometry/polygon.h"

namespace adit {

/// A point of the design line.
struct ProfilePoint {
  double p_m = 0.0;  ///< arc length from the crown, clockwise looking up-chainage
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< outward, unit
  double curvature_per_m = 0.0;                       ///< positive where the line is convex (arch), 0 on lines
};

/// Nearest point of the design line to a point of the section.
struct ProfileFoot {
  double p_m = 0.0;
  double deviation_m = 0.0;                              ///< signed distance, outside positive (overbreak)
  Eigen::Vector2d direction = Eigen::Vector2d::UnitY();  ///< unit, outward: position = foot + deviation * direction
  int corner = -1;                                       ///< index into corners() when the foot is a corner, else -1
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
  /// Takes the segments in either sense of rotation, from any start. Throws Error when they do not join (1 mm), do not
  /// close, cross themselves, have no inside (0.01 m2), measure over 500 m or are not finite; the message names the
  /// segments, counted from 1 as given, and the place.
  Profile(std::string name, std::vector<ProfileSegment> segments);

  const std::string& name() const { return name_; }
  /// Clockwise from the crown; the crown splits a segment where it is not an end.
  const std::vector<ProfileSegment>& segments() const { return segments_; }
  /// Places where the tangent turns by more than 0.1 degrees.
  const std::vector<ProfileCorner>& corners() const { return corners_; }
  double length_m() const { return length_m_; }
  double area_m2() const { return area_m2_; }
  Eigen::AlignedBox2d box() const { return box_; }

  /// p in [-length/2, length/2).
  double wrapped_p(double p_m) const;
  /// Any p, wrapped first. At a joint the later segment answers.
  ProfilePoint at(double p_m) const;
  /// Exact on lines, arcs and corners; about 0.1 microseconds on a profile of a few segments.
  ProfileFoot nearest(const Eigen::Vector2d& point) const;
  /// The line itself belongs to the inside.
  bool contains(const Eigen::Vector2d& point) const;

  /// Ring of points on the line, clockwise from the crown, arcs within the tolerance.
  Polygon flattened(double tolerance_m = 1e-5) const;

 private:
  struct Group {  ///< pieces first..last (exclusive) and the box around them
    Eigen::AlignedBox2d box;
    std::size_t first;
    std::size_t last;
  };
  struct Nearest {
    double squared_distance;
    std::size_t piece;
    ProfilePiece::Where where;
  };

  void lay_pieces();
  void lay_corners();
  void scan(const Eigen::Vector2d& point, const Group& group, Nearest& best) const;
  Nearest nearest_piece(const Eigen::Vector2d& point) const;
  ProfileFoot joint_foot(const Eigen::Vector2d& point, std::size_t joint) const;

  std::string name_;
  std::vector<ProfileSegment> segments_;
  std::vector<ProfilePiece> pieces_;
  std::vector<Group> groups_;
  std::vector<ProfileCorner> corners_;
  std::vector<ProfileCorner> joints_;  ///< at the start of every piece, whether it turns or not
  std::vector<int> corner_of_joint_;   ///< index into corners_, or -1
  double length_m_ = 0.0;
  double area_m2_ = 0.0;
  Eigen::AlignedBox2d box_;
};

}  // namespace adit
