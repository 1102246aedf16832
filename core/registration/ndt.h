#pragma once
// Normal distributions transform: first engine, through PCL (Magnusson et al. 2007).

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit {

struct NdtOptions {
  double cell_m = 1.0;
  int most_iterations = 40;
  double source_spacing_m = 0.3;  ///< the source is thinned to this
};

/// target_from_source near the guess. Never fails: a poor fit is for the judge to see.
Pose ndt_align(const PreparedScan& target, const PreparedScan& source, const Pose& guess, const NdtOptions& options,
               Progress& progress);

}  // namespace adit
