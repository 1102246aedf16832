#pragma once
// Iterative closest point, point to plane: PCL's, the yardstick.

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit::bench {

struct PclIcpOptions {
  double match_distance_m = 0.5;
  int most_iterations = 40;
};

/// target_from_source near the guess. Never fails: a poor fit is for the judge to see.
Pose pcl_icp_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                   const PclIcpOptions& options, Progress& progress);

}  // namespace adit::bench
