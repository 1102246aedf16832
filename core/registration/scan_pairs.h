#pragma once
// Which scans are matched with which, and the matching of all of them.

#include <vector>

#include "core/registration/nodes.h"
#include "core/registration/register_pair.h"

namespace adit {

/// Indices of nodes.
struct Candidate {
  std::size_t target = 0;
  std::size_t source = 0;
  bool operator==(const Candidate&) const = default;
};

/// Candidates and what came of each.
struct MatchedPairs {
  std::vector<Candidate> candidates;
  std::vector<PairResult> results;
};

/// Pairs of near stations that overlap at their starts; each scan keeps its nearest few. One that overlaps
/// none is paired with its nearest all the same.
std::vector<Candidate> candidate_pairs(const std::vector<Node>& nodes, const RegistrationOptions& options);

/// Whether what a pair shows in common lies on the same surfaces: 45 % of it, and three times what was seen through
/// more. Less than any right place has, and as much as wrong ones in rock have; in a corridor a scan laid upon the
/// other one agrees by 56 %, but 5 % was seen through.
/// And the median residual must be within five times the scans' own noise: right places have 1 to 2 times, a scan
/// turned about in rock of 30 mm has 9 times.
bool lies_well(const PairResult& pair);

/// register_pair, and when what the scans show does not agree near the guess, once more from where a search finds the
/// place without it.
PairResult matched_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                        const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress);

/// Matches all candidates. Not used are those that overlap too little and those that do not agree.
MatchedPairs register_pairs(const std::vector<Node>& nodes, std::vector<Candidate> candidates,
                            const RegistrationContext& context, const RegistrationOptions& options, Progress& progress);

/// After some nodes have moved: what their pairs do not know they were told by wrong starts, so that these, and the
/// pairs that were not used or no candidates, are matched (again).
MatchedPairs register_moved(const std::vector<Node>& nodes, const std::vector<bool>& moved, MatchedPairs before,
                            const RegistrationContext& context, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
