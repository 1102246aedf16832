#include "core/registration/wrong_guesses.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double wrong_sigmas = 4.0;

/// The used pairs of each node whose partner has a guess too: how many there are, and how many contradict both. A pair
/// that is held at the guess bears out none.
struct Votes {
  std::size_t pairs = 0;
  std::size_t against = 0;
};

bool contradicts(const Node& target, const Node& source, const PairResult& pair, const RegistrationOptions& options) {
  const Pose guess = target.start.inverse() * source.start;
  return distance_between_m(guess, pair.target_from_source) > wrong_sigmas * options.guess_sigma_m ||
         rotation_between_rad(guess, pair.target_from_source) > wrong_sigmas * rad_from_deg(options.guess_sigma_deg);
}

std::vector<Votes> votes_of(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                            const std::vector<PairResult>& pairs, const RegistrationOptions& options) {
  std::vector<Votes> votes(nodes.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const Node& target = nodes[candidates[k].target];
    const Node& source = nodes[candidates[k].source];
    if (!pairs[k].used || target.by == Node::By::search || source.by == Node::By::search) continue;
    const std::size_t against = contradicts(target, source, pairs[k], options) ? 1 : 0;
    if (against == 0 && !pairs[k].undetermined.empty()) continue;
    for (const std::size_t node : {candidates[k].target, candidates[k].source}) {
      ++votes[node].pairs;
      votes[node].against += against;
    }
  }
  return votes;
}

/// The node whose guess most pairs are against, and none for; the last of several.
std::optional<std::size_t> wrong_node(const std::vector<Node>& nodes, const std::vector<Votes>& votes) {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool outvoted = votes[i].against > 0 && votes[i].against == votes[i].pairs;
    if (!outvoted || nodes[i].by != Node::By::guess || nodes[i].control.size() >= least_targets) continue;
    if (!worst || votes[i].against >= votes[*worst].against) worst = i;
  }
  return worst;
}

/// Nodes that were set aside start where a partner puts them, those next to the others first.
void start_from_partners(std::vector<Node>& nodes, std::vector<bool> set_aside,
                         const std::vector<Candidate>& candidates, const std::vector<PairResult>& pairs) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [target, source] = candidates[k];
      if (!pairs[k].used || set_aside[target] == set_aside[source]) continue;
      if (set_aside[source])
        nodes[source].start = nodes[target].start * pairs[k].target_from_source;
      else
        nodes[target].start = nodes[source].start * pairs[k].target_from_source.inverse();
      set_aside[target] = set_aside[source] = false;
      changed = true;
    }
  }
}

}  // namespace

std::vector<bool> set_aside_wrong_guesses(std::vector<Node>& nodes, const MatchedPairs& pairs,
                                          const RegistrationOptions& options, Findings& findings) {
  std::vector<bool> set_aside(nodes.size(), false);
  const std::vector<Node> guessed = nodes;
  while (const auto wrong = wrong_node(nodes, votes_of(nodes, pairs.candidates, pairs.results, options))) {
    nodes[*wrong].by = Node::By::search;
    set_aside[*wrong] = true;
  }
  start_from_partners(nodes, set_aside, pairs.candidates, pairs.results);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!set_aside[i]) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  "its guess is %.2f m and %.1f degrees from where its walls meet those of the other scans: set aside, "
                  "the scan is placed by the clouds alone",
                  distance_between_m(guessed[i].start, nodes[i].start),
                  deg_from_rad(rotation_between_rad(guessed[i].start, nodes[i].start)));
    findings.push_back({Severity::decision, "scan " + nodes[i].prepared->name, words,
                        "check its pose in job.json and those of the scans beside it"});
  }
  return set_aside;
}

}  // namespace adit
