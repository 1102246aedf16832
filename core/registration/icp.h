#pragma once
// Iterative closest point with its stages as choices. What the register step does by default (surface_match.h) is
// better on tunnels (docs/accuracy.md); these are the field's, for comparison and for those who want them.

#include <vector>

#include "core/foundation/progress.h"
#include "core/registration/icp_cloud.h"
#include "core/registration/icp_metric.h"

namespace adit {

struct IcpResult {
  Pose target_from_source = Pose::Identity();
  int iterations = 0;
  std::size_t matches = 0;  ///< of the last iteration, those rejected left out
};

/// From a start that is nearer than the reach to where most points belong. Stops early where fewer than 10 pairs of
/// points remain. The same on any number of threads.
IcpResult icp_align(const IcpTarget& target, const IcpCloud& source, const Pose& start, const IcpOptions& options,
                    Progress& progress);

/// The pairs of points of one iteration, weighted, those rejected left out.
std::vector<IcpMatch> icp_matches(const IcpTarget& target, const IcpCloud& source, const Pose& target_from_source,
                                  const IcpOptions& options, int iteration, Progress& progress);

}  // namespace adit
