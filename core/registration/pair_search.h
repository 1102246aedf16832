#pragma once
// Where could one scan stand in another, when nothing is known about it?

#include <vector>

#include "core/foundation/progress.h"
#include "core/registration/fit_check.h"
#include "core/registration/plan_view.h"

namespace adit {

/// A way to lay a pair together.
struct PairPlace {
  Pose target_from_source = Pose::Identity();
  FitCheck check;
};

struct PairSearchOptions {
  double reach_m = 22.0;         ///< farthest distance of two stations along and across
  std::size_t most_starts = 80;  ///< from the plans
};

/// Starts from the plans of both scans, descends from each with the normal distributions transform in coarse cells,
/// keeps the best few in finer ones, and judges these by fit and free space; the best first. Any yaw; both scans within
/// some 20 degrees of level. Empty when the plans do not meet at all.
std::vector<PairPlace> search_pair(const PreparedScan& target, const PlanView& target_plan, const PreparedScan& source,
                                   const PlanView& source_plan, const PairSearchOptions& options, Progress& progress);

}  // namespace adit
