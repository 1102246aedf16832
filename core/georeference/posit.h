#pragma once
// POSIT: the pose of a camera from points and their pictures, without a guess.

#include <Eigen/Core>

#include <vector>

#include "core/geometry/pose.h"

namespace adit {

/// A pose that POSIT has found, and how far it leaves the picture from the points.
struct PositPose {
  Pose camera_from_site = Pose::Identity();
  double rms = 0.0;  ///< of the places on the plane z = 1
  int iterations = 0;
};

/// Poses for points (any frame, not all on one line) seen at places of the plane z = 1. Scaled orthography solved
/// linearly with the pseudoinverse of the points' differences, then corrected by each point's own depth until it stays
/// the same (DeMenthon, Davis 1995, as in Wang, Wu, Li 2011, section 4). Points in a plane leave two poses (Oberkampf,
/// DeMenthon, Davis 1996), better one first. Empty for fewer than four points, points on one line, and where the
/// iteration does not end in a pose with all points ahead.
std::vector<PositPose> posit(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector2d>& places);

/// How far points leave one plane: least over greatest spread (root mean square) along their principal axes, 0 in a
/// plane.
double flatness(const std::vector<Eigen::Vector3d>& points);

/// Below this flatness points count as lying in a plane.
inline constexpr double flat_points = 0.03;

}  // namespace adit
