#pragma once
// What a person must know of the control of a registration, in words.

#include "core/registration/adjustment.h"
#include "core/registration/nodes.h"

namespace adit {

/// Residuals of control with their redundancy; those that fail the blunder test (wrong_normalised), and the target of
/// which least is checked by anything else, as findings.
void report_control(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                    const PoseGraph& graph, const std::vector<Node>& nodes);

/// Control that stands off or turned from all guesses, one way: one mistake moves everything, and nothing within the
/// survey contradicts it.
void compare_guesses_with_control(RegistrationResult& result, const std::vector<Node>& nodes,
                                  const RegistrationOptions& options);

}  // namespace adit
