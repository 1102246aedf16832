#pragma once
// What iterative closest point makes as small as can be, and the step that does.

#include <span>

#include "core/geometry/pose.h"
#include "core/registration/icp_options.h"

namespace adit {

/// Target's frame; normals are zero where none are known.
struct IcpMatch {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();   ///< of the source's point
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< there
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< the point of the target that belongs to it
  Eigen::Vector3d target_normal = Eigen::Vector3d::Zero();
  double weight = 1.0;

  double distance_m() const { return (target - place).norm(); }
};

/// The step (rotation [rad] about `origin`, translation [m]) that brings the source nearer. At least three matches.
/// Closed form after Besl and McKay (1992) by singular values (Kabsch), or one Gauss-Newton step.
Vector6d icp_step(std::span<const IcpMatch> matches, const Eigen::Vector3d& origin, IcpMetric metric);

}  // namespace adit
