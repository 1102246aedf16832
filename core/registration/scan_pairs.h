#pragma once
// Which scans are matched with which, and the matching of all of them.

#include <vector>

#include "core/registration/nodes.h"

namespace adit {

/// Indices of nodes.
struct Candidate {
  std::size_t target = 0;
  std::size_t source = 0;
};

/// Pairs of near stations that overlap at their starts; each scan keeps its nearest few.
std::vector<Candidate> candidate_pairs(const std::vector<Node>& nodes, const RegistrationOptions& options);

/// One result for each candidate. Too little overlap, or surfaces that do not fit and were seen through: not used.
std::vector<PairResult> register_pairs(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                                       const RegistrationContext& context, const RegistrationOptions& options,
                                       Progress& progress);

}  // namespace adit
