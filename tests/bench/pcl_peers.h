#pragma once
// PCL's registrations as users call them: the yardsticks. Whole jobs: from the points of two scans to a pose.

#include <Eigen/Core>

#include <vector>

#include "core/geometry/pose.h"

namespace adit::bench {

using Points = std::vector<Eigen::Vector3f>;

/// All thin both scans by PCL's voxel grid of 0.2 m and give target_from_source near the guess, on one thread.
Pose pcl_gicp(const Points& target, const Points& source, const Pose& guess);
Pose pcl_ndt(const Points& target, const Points& source, const Pose& guess);
Pose pcl_icp(const Points& target, const Points& source, const Pose& guess);
Pose pcl_icp_to_plane(const Points& target, const Points& source, const Pose& guess);

}  // namespace adit::bench
