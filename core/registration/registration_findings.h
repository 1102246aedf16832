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

/// Directions of a scan whose sigma is too great to be called known. guessed: "held" is said of what is
/// no better known than a guess.
void name_undetermined(PlacedScan& scan, bool held, const RegistrationOptions& options, Findings& findings);

/// A scan that ended far from its guess, all guesses being moved as the datum asks: the guess was wrong, or the match
/// is.
void compare_with_guess(const PlacedScan& scan, const Node& node, const Pose& moved_from_guesses,
                        const RegistrationOptions& options, Findings& findings);

/// The datum stands at its guess: how far from it the guesses of all others, and the clouds between, would put it.
void compare_datum_with_guesses(const PlacedScan& datum, const Pose& moved_from_guesses,
                                const RegistrationOptions& options, Findings& findings);

/// Loops that pairs which know every direction leave open by more than a direction may be unknown.
void report_loops(RegistrationResult& result, const RegistrationOptions& options);

/// Scans that neither pairs nor control tie to the datum: each alone, or those that pairs tie to one another as a
/// group. tied, group: of each node; a group is known by its first node.
void report_untied(RegistrationResult& result, const std::vector<Node>& nodes, const std::vector<bool>& tied,
                   const std::vector<std::size_t>& group);

/// With fewer than three targets in all the place of the whole survey is only as good as the guess of its datum scan,
/// and so is every number against a design.
void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options);

}  // namespace adit
