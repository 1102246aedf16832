#pragma once
// What a person must know of a registration, in words.

#include "core/registration/adjustment.h"
#include "core/registration/nodes.h"

namespace adit {

/// Pairs that overlap and yet do not show the same surfaces, that fit as well elsewhere along the tunnel, and those of
/// which one scan is larger than the other.
void report_pairs(RegistrationResult& result, const RegistrationOptions& options);

/// What contradicted the rest, and what was done about it.
void report_contradictions(RegistrationResult& result, const Adjustment& adjustment, const PoseGraph& graph,
                           const std::vector<Node>& nodes);

/// Residuals of control with their redundancy; those that fail the blunder test (wrong_normalised) as
/// findings.
void report_control(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                    const PoseGraph& graph, const std::vector<Node>& nodes, const RegistrationOptions& options);

/// Directions of a scan whose sigma is too great to be called known. guessed: "held" is said of what is
/// no better known than a guess.
void name_undetermined(PlacedScan& scan, bool held, const RegistrationOptions& options, Findings& findings);

/// A scan that ended far from its guess: the guess was wrong, or the match is.
void compare_with_guess(const PlacedScan& scan, const Node& node, const RegistrationOptions& options,
                        Findings& findings);

/// Loops that pairs which know every direction leave open by more than a direction may be unknown.
void report_loops(RegistrationResult& result, const RegistrationOptions& options);

/// Control that no guess agrees with: one mistake moves everything, and nothing within the survey contradicts it.
void compare_guesses_with_control(RegistrationResult& result, const std::vector<Node>& nodes,
                                  const RegistrationOptions& options);

/// With fewer than three targets in all the place of the whole survey is only as good as the guess of its datum scan,
/// and so is every number against a design.
void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options);

}  // namespace adit
