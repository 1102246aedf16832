#pragma once
// All scans at once, after each pair alone.

#include "core/registration/adjustment.h"
#include "core/registration/nodes.h"

namespace adit {

struct JointRefinement {
  PoseGraph graph;         ///< what was used, with every pair measured anew where the adjustment put its scans
  PoseGraphResult solved;  ///< its solution
};

/// Gauss-Newton steps over the surfaces of all pairs together: each pair gives the step its surfaces ask for at the
/// present poses, the graph weighs all of them with control, and so again until no scan moves by a hundredth of a
/// millimetre (three times at most). Directions that a pair does not determine are left as they are, and pairs that
/// fit as well elsewhere keep their transform: the adjustment stands where they do not meet.
JointRefinement refine_jointly(const PoseGraph& graph, const Adjustment& adjustment, const std::vector<Node>& nodes,
                               const std::vector<PairResult>& pairs, const RegistrationContext& context,
                               Progress& progress);

}  // namespace adit
