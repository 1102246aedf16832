#pragma once
// Normal distributions transform: PCL's, the yardstick (Magnusson et al. 2007).

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit::bench {

struct PclNdtOptions {
  double cell_m = 1.0;
  int most_iterations = 40;
  double source_spacing_m = 0.3;  ///< the source is thinned to this
};

/// target_from_source near the guess. Never fails: a poor fit is for the judge to see.
Pose pcl_ndt_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                   const PclNdtOptions& options, Progress& progress);

}  // namespace adit::bench
