#include "core/registration/wrong_guesses.h"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double wrong_sigmas = 4.0;

/// Transforms of pairs from each node to those near it: by pairs, the shortest way.
struct Seen {
  std::size_t node = 0;
  Pose from_node = Pose::Identity();  ///< its place in the frame of the one that sees it
  std::size_t steps = 0;
  bool direct = false;  ///< no node with a guess stands between
};

bool has_guess(const Node& node) {
  return node.by != Node::By::search;
}

bool contradicts(const Node& node, const Seen& seen, const std::vector<Node>& nodes,
                 const RegistrationOptions& options) {
  const Pose guess = node.start.inverse() * nodes[seen.node].start;
  const double turn_rad = rad_from_deg(options.guess_sigma_deg);
  const double beside_m = static_cast<double>(seen.steps - 1) * turn_rad * seen.from_node.translation().norm();
  return distance_between_m(guess, seen.from_node) > wrong_sigmas * (options.guess_sigma_m + beside_m) ||
         rotation_between_rad(guess, seen.from_node) > wrong_sigmas * turn_rad;
}

/// Pairs that lead somewhere: a pair that is held at the guess bears it out and says nothing, unless it contradicts it.
std::vector<bool> telling(const std::vector<Node>& nodes, const MatchedPairs& pairs,
                          const RegistrationOptions& options) {
  std::vector<bool> tells;
  for (std::size_t k = 0; k < pairs.results.size(); ++k) {
    const PairResult& pair = pairs.results[k];
    const Seen seen{pairs.candidates[k].source, pair.target_from_source, 1, true};
    tells.push_back(pair.used && (pair.undetermined.empty() ||
                                  contradicts(nodes[pairs.candidates[k].target], seen, nodes, options)));
  }
  return tells;
}

/// Those within three pairs of a node, itself not among them.
std::vector<Seen> seen_from(std::size_t node, const std::vector<Node>& nodes, const MatchedPairs& pairs,
                            const std::vector<bool>& tells) {
  constexpr std::size_t most_steps = 3;
  std::vector<Seen> seen{{node, Pose::Identity(), 0, true}};
  std::vector<bool> known(nodes.size(), false);
  known[node] = true;
  for (std::size_t at = 0; at < seen.size(); ++at) {
    const Seen here = seen[at];
    if (here.steps == most_steps) break;
    for (std::size_t k = 0; k < pairs.candidates.size(); ++k) {
      const auto [target, source] = pairs.candidates[k];
      if (!tells[k] || (target != here.node && source != here.node)) continue;
      const std::size_t to = target == here.node ? source : target;
      if (known[to]) continue;
      known[to] = true;
      const Pose& step = pairs.results[k].target_from_source;
      const bool direct = here.direct && (at == 0 || !has_guess(nodes[here.node]));
      seen.push_back(
          {to, here.from_node * (target == here.node ? step : Pose(step.inverse())), here.steps + 1, direct});
    }
  }
  seen.erase(seen.begin());
  return seen;
}

/// How the guesses about a node stand to its own.
struct Votes {
  int direct_for = 0, direct_against = 0;
  int all_against = 0;  ///< less those for it
};

Votes votes_of(std::size_t node, const std::vector<Node>& nodes, const MatchedPairs& pairs,
               const std::vector<bool>& tells, const RegistrationOptions& options) {
  Votes votes;
  for (const Seen& seen : seen_from(node, nodes, pairs, tells)) {
    if (!has_guess(nodes[seen.node])) continue;
    const bool against = contradicts(nodes[node], seen, nodes, options);
    votes.all_against += against ? 1 : -1;
    if (seen.direct) ++(against ? votes.direct_against : votes.direct_for);
  }
  return votes;
}

/// The node whose guess all direct partners are against, and of these most others, too; the last of several.
std::optional<std::size_t> wrong_node(const std::vector<Node>& nodes, const MatchedPairs& pairs,
                                      const std::vector<bool>& tells, const RegistrationOptions& options) {
  std::optional<std::size_t> worst;
  int most = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].by != Node::By::guess || nodes[i].is_placed()) continue;
    const Votes votes = votes_of(i, nodes, pairs, tells, options);
    if (votes.direct_against == 0 || votes.direct_for > 0 || (worst && votes.all_against < most)) continue;
    worst = i;
    most = votes.all_against;
  }
  return worst;
}

/// Nodes without a guess start where a partner puts them, those next to the others first. A group without any guess
/// stays.
void start_from_partners(std::vector<Node>& nodes, const MatchedPairs& pairs) {
  std::vector<bool> stands;
  for (const Node& node : nodes) stands.push_back(has_guess(node));
  if (std::find(stands.begin(), stands.end(), true) == stands.end()) return;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < pairs.results.size(); ++k) {
      const auto [target, source] = pairs.candidates[k];
      if (!pairs.results[k].used || stands[target] == stands[source]) continue;
      const Pose& pair = pairs.results[k].target_from_source;
      if (stands[target])
        nodes[source].start = nodes[target].start * pair;
      else
        nodes[target].start = nodes[source].start * pair.inverse();
      stands[target] = stands[source] = true;
      changed = true;
    }
  }
}

}  // namespace

std::vector<bool> set_aside_wrong_guesses(std::vector<Node>& nodes, const MatchedPairs& pairs,
                                          const RegistrationOptions& options) {
  std::vector<bool> set_aside(nodes.size(), false);
  const std::vector<bool> tells = telling(nodes, pairs, options);
  bool any = false;
  while (const auto wrong = wrong_node(nodes, pairs, tells, options)) {
    nodes[*wrong].by = Node::By::search;
    set_aside[*wrong] = any = true;
  }
  if (any) start_from_partners(nodes, pairs);
  return set_aside;
}

void take_back_right_guesses(const std::vector<Node>& guessed, std::vector<Node>& nodes,
                             const RegistrationOptions& options) {
  const double most_rad = wrong_sigmas * rad_from_deg(options.guess_sigma_deg);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (distance_between_m(guessed[i].start, nodes[i].start) <= wrong_sigmas * options.guess_sigma_m &&
        rotation_between_rad(guessed[i].start, nodes[i].start) <= most_rad)
      nodes[i] = guessed[i];
}

void report_wrong_guesses(const std::vector<Node>& guessed, const std::vector<Node>& nodes, Findings& findings) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (guessed[i].by != Node::By::guess || nodes[i].by == Node::By::guess) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  "its guess is %.2f m and %.1f degrees from where its walls meet those of the other scans: set aside, "
                  "the scan is placed by the clouds alone",
                  distance_between_m(guessed[i].start, nodes[i].start),
                  deg_from_rad(rotation_between_rad(guessed[i].start, nodes[i].start)));
    findings.push_back({Severity::decision, "scan " + nodes[i].prepared->name, words,
                        "check its pose in job.json and those of the scans beside it"});
  }
}

}  // namespace adit
