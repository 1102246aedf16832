#pragma once
// The normal distributions transform in 3D, from coarse cells to fine ones (Magnusson et al. 2007).

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/distribution_map.h"
#include "core/registration/ndt_options.h"

namespace adit {

struct NdtAlignment {
  Pose target_from_source = Pose::Identity();
  double score = 0.0;  ///< mean of the source's distributions in the finest cells; least is best, 0 means no overlap
  int iterations = 0;  ///< of all sizes together
};

/// target_from_source near the guess. Never fails: a poor fit is for the judge to see.
NdtAlignment ndt_align(const DistributionPyramid& target, const DistributionPyramid& source, const Pose& guess,
                       const NdtOptions& options, Progress& progress);

}  // namespace adit
