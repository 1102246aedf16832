#pragma once
// Where the plane of a coded target is seen.

#include <Eigen/Core>

namespace adit {

/// The plane of a target in a picture: a place (x, y) of the pattern, in outer radii, is seen at
/// center + shape (x, y) / (1 + tilt . (x, y)). The centre is that of the circle in space, not of the ellipse it is
/// seen as: perspective sets them apart.
struct TargetPlace {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();     ///< pixels
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();  ///< pixels for one outer radius
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();       ///< perspective: how the scale falls off over one outer radius

  Eigen::Vector2d pixel(const Eigen::Vector2d& at) const { return center + shape * at / (1.0 + tilt.dot(at)); }
};

}  // namespace adit
