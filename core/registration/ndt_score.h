#pragma once
// How well one scan's distributions (or points) lie upon another's, and how that changes with the pose.

#include <span>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/distribution_map.h"
#include "core/registration/ndt_options.h"

namespace adit {

/// Score (least is best) with gradient and Hessian about (rotation [rad], translation [m]) in the target's frame at the
/// source's origin.
struct NdtScore {
  double score = 0.0;
  Vector6d gradient = Vector6d::Zero();
  Matrix6d hessian = Matrix6d::Zero();
  double weight = 0.0;  ///< of the sources looked at

  NdtScore& operator+=(const NdtScore& other);
};

/// - sum over sources s and target distributions t near them of exp(-d2/2 q^T (C_t + R C_s R^T)^-1 q) w(|q| / cell)
/// with q = mean_t's distance of the moved mean_s: eq. 3 to 6 for points (C_s = 0), and Stoyanov et al. 2012 for
/// distributions. w = (1 - |q|^2 / cell^2)^3 ends the sum at one cell's distance without a step, so that the score and
/// its first two derivatives are continuous in the pose. Every source counts alike, however many points it holds.
NdtScore ndt_score(const DistributionMap& target, std::span<const NormalDistribution> source,
                   const Pose& target_from_source, const NdtScoreOptions& options, Progress& progress);

}  // namespace adit
