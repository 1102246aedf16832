#pragma once
// A guess that is far off must not decide which pairs are believed.

#include "core/registration/scan_pairs.h"

namespace adit {

/// Where the pairs of a scan put it more than four sigmas from its guess, seen from the guesses of all its partners,
/// that guess is set aside: the node starts from a partner instead, as a searched one does, and a finding says so. Of
/// two guesses that contradict each other alone, the later one. Scans with three targets keep theirs. True for those
/// nodes.
std::vector<bool> set_aside_wrong_guesses(std::vector<Node>& nodes, const MatchedPairs& pairs,
                                          const RegistrationOptions& options, Findings& findings);

}  // namespace adit
