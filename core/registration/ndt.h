#pragma once
// The normal distributions transform in 3D, from coarse cells to fine ones (Magnusson et al. 2007).

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/distribution_map.h"
#include "core/registration/ndt_score.h"

namespace adit {

struct NdtOptions {
  double coarsest_cell_m = 4.0;  ///< the search begins with the target's cells of about this size
  /// And ends with these, or the second finest there are: in smaller ones a thin, noisy scan of a smooth place tilts by
  /// degrees at no cost to the score.
  double finest_cell_m = 0.4;
  /// Rounds of blasting repeat every few metres, and so does the rock they leave. Starts so far along the direction
  /// that the coarsest cells know least are tried too, both ways; 0: none.
  double search_m = 4.0;
  NdtScoreOptions score;
  int most_iterations = 30;  ///< of each size of cells
};

struct NdtAlignment {
  Pose target_from_source = Pose::Identity();
  double score = 0.0;  ///< mean of the source's distributions in the finest cells; least is best, 0 means no overlap
  int iterations = 0;  ///< of all sizes together
};

/// target_from_source near the guess. The source's distributions are those of half the target's cells: with cells
/// alike, the two grids would lock onto each other. Never fails: a poor fit is for the judge to see.
NdtAlignment ndt_align(const DistributionPyramid& target, const DistributionPyramid& source, const Pose& guess,
                       const NdtOptions& options, Progress& progress);

}  // namespace adit
