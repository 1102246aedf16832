#pragma once
// What is to be said of pictures and cameras after the adjustment.

#include <vector>

#include "core/registration/adjustment.h"
#include "core/registration/nodes.h"

namespace adit {

/// Residuals of the pictures and where the cameras sit. Decisions: a picture, and a lever arm, that lie farther off the
/// rest than one in 7,000 by chance.
void report_pictures(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                     const PoseGraph& graph, const std::vector<Node>& nodes, const RegistrationContext& context);

/// Scans that stand, by their pictures, farther from the job's guess than guesses are worth: one of both is wrong.
void compare_guesses_with_pictures(RegistrationResult& result, const std::vector<ScanToPlace>& scans,
                                   const std::vector<Node>& nodes, const RegistrationOptions& options);

}  // namespace adit
