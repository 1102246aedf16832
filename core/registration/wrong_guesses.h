#pragma once
// A guess that is far off must not decide which pairs are believed.

#include "core/registration/scan_pairs.h"

namespace adit {

/// Where the pairs of a scan put it more than four sigmas from its guess, seen from the guesses of all its partners,
/// that guess is set aside: the node starts from a partner instead, as a searched one does. First that which most
/// guesses within three pairs contradict; of two that contradict each other alone, the later one. Scans with three
/// targets keep theirs. True for those nodes.
std::vector<bool> set_aside_wrong_guesses(std::vector<Node>& nodes, const MatchedPairs& pairs,
                                          const RegistrationOptions& options);

/// Guesses that were set aside and do not contradict where their nodes start now are right again.
void take_back_right_guesses(const std::vector<Node>& guessed, std::vector<Node>& nodes,
                             const RegistrationOptions& options);

/// A finding for each node that had a guess and has none any more. guessed: the nodes as they were.
void report_wrong_guesses(const std::vector<Node>& guessed, const std::vector<Node>& nodes, Findings& findings);

}  // namespace adit
