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
};

/// Pairs of near stations that overlap at their starts; each scan keeps its nearest few.
std::vector<Candidate> candidate_pairs(const std::vector<Node>& nodes, const RegistrationOptions& options);

/// Of what a pair shows in common, as much must lie on the same surfaces: less than any right place has, and as much as
/// wrong ones in rock have.
inline constexpr double least_agreeing = 0.45;

/// register_pair, and when what the scans show does not agree near the guess, once more from where a search finds the
/// place without it.
PairResult matched_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                        const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress);

/// One result for each candidate. Not used are those that overlap too little, those that do not agree, and those with
/// directions that they do not know between scans which other pairs tie together in every direction.
std::vector<PairResult> register_pairs(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                                       const RegistrationContext& context, const RegistrationOptions& options,
                                       Progress& progress);

}  // namespace adit
