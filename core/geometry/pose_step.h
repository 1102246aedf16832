#pragma once
// Small turns and shifts of a pose, as searches make them.

#include "core/geometry/pose.h"

namespace adit {

/// The matrix whose product with b is v x b.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// The pose turned about the source's origin and moved, by a step (rotation vector [rad], translation [m]) in the
/// target's frame.
inline Pose stepped(const Pose& target_from_source, const Vector6d& step) {
  Pose next = target_from_source;
  next.linear() = Eigen::Quaterniond(rotation_from_vector(step.head<3>()) * target_from_source.linear())
                      .normalized()
                      .toRotationMatrix();
  next.translation() += step.tail<3>();
  return next;
}

}  // namespace adit
