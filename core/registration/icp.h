#pragma once
// Iterative closest point, point to plane: first engine, through PCL.

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit {

struct IcpOptions {
  double match_distance_m = 0.5;
  int most_iterations = 40;
};

/// target_from_source near the guess. Never fails: a poor fit is for the judge to see.
Pose icp_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess, const IcpOptions& options,
               Progress& progress);

}  // namespace adit
