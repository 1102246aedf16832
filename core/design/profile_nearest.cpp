// Nearest point of the design line: the innermost call of every deviation.
#include <cmath>
#include <limits>

#include "core/design/profile.h"

namespace adit {

void Profile::scan(const Eigen::Vector2d& point, const Group& group, Nearest& best) const {
  for (std::size_t i = group.first; i < group.last; ++i) {
    const ProfilePiece::Near near = pieces_[i].nearest(point);
    if (near.squared_distance < best.squared_distance) best = {near.squared_distance, i, near.where};
  }
}

Profile::Nearest Profile::nearest_piece(const Eigen::Vector2d& point) const {
  Nearest best{std::numeric_limits<double>::infinity(), 0, ProfilePiece::Where::inside};
  if (groups_.size() == 1) {
    scan(point, groups_.front(), best);
    return best;
  }
  const Group* start = &groups_.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Group& group : groups_) {
    const double distance = group.box.squaredExteriorDistance(point);
    if (distance < least) {
      least = distance;
      start = &group;
    }
  }
  scan(point, *start, best);
  for (const Group& group : groups_) {
    if (&group != start && group.box.squaredExteriorDistance(point) < best.squared_distance) scan(point, group, best);
  }
  return best;
}

ProfileFoot Profile::joint_foot(const Eigen::Vector2d& point, std::size_t joint) const {
  const ProfileCorner& corner = joints_[joint];
  // The normal turned halfway, clockwise: it lies in the wedge of a convex corner and against that of a hollow one.
  const double half = 0.5 * corner.turn_rad;
  const Eigen::Vector2d n = corner.normal_before;
  const Eigen::Vector2d bisector(n.x() * std::cos(half) + n.y() * std::sin(half),
                                 n.y() * std::cos(half) - n.x() * std::sin(half));
  const Eigen::Vector2d away = point - corner.position;
  const double distance = away.norm();
  const int index = corner_of_joint_[joint];
  if (distance == 0.0) return {corner.p_m, 0.0, bisector, index};
  const double deviation = std::copysign(distance, away.dot(bisector));
  return {corner.p_m, deviation, away / deviation, index};
}

ProfileFoot Profile::nearest(const Eigen::Vector2d& point) const {
  const Nearest near = nearest_piece(point);
  if (near.where == ProfilePiece::Where::start) return joint_foot(point, near.piece);
  if (near.where == ProfilePiece::Where::end) return joint_foot(point, (near.piece + 1) % pieces_.size());
  const ProfilePiece& piece = pieces_[near.piece];
  const ProfilePiece::Foot foot = piece.foot(point);
  double p = piece.first_p_m + piece.half_length_m + foot.along_m;
  if (p >= 0.5 * length_m_) p -= length_m_;
  if (!piece.is_arc()) return {p, foot.deviation_m, piece.radial, -1};
  // Away from the centre, without a sine: the sign follows from the side of the arc.
  const Eigen::Vector2d centre = piece.middle - piece.radius_m * piece.radial;
  const Eigen::Vector2d from_centre = point - centre;
  const double distance = from_centre.norm();
  const Eigen::Vector2d direction = distance > 1e-9 * piece.radius_m
                                        ? Eigen::Vector2d(piece.outward * from_centre / distance)
                                        : Eigen::Vector2d(piece.outward * piece.radial);
  return {p, foot.deviation_m, direction, -1};
}

bool Profile::contains(const Eigen::Vector2d& point) const {
  return nearest(point).deviation_m <= 0.0;
}

}  // namespace adit
