#pragma once
// Axis-aligned boxes.

#include <Eigen/Geometry>

namespace adit {

/// Empty until something is put in; `box.extend(point)`, `box.isEmpty()`.
using BoundingBox = Eigen::AlignedBox3d;

/// The box around a box moved by a rigid transform.
inline BoundingBox moved(const BoundingBox& box, const Eigen::Isometry3d& target_from_source) {
  BoundingBox result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner)
    result.extend(target_from_source * box.corner(static_cast<BoundingBox::CornerType>(corner)));
  return result;
}

}  // namespace adit
