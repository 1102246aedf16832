#include "core/registration/scan_pairs.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include "core/foundation/parallel.h"
#include "core/registration/fit_check.h"
#include "core/registration/found_place.h"
#include "core/registration/pair_sheet.h"

namespace adit {
namespace {

constexpr std::size_t most_pairs_a_scan = 4;

std::string why_not(const PairResult& pair, const RegistrationOptions& options) {
  char words[160];
  if (pair.overlap < options.least_overlap) {
    std::snprintf(words, sizeof words, "overlaps by only %.0f %%", 100.0 * pair.overlap);
    return words;
  }
  if (lies_well(pair)) return {};
  std::snprintf(words, sizeof words,
                "lies on the same surfaces with only %.0f %% of what both show, median %.1f mm, %.1f %% seen through",
                100.0 * pair.agreeing, 1e3 * pair.median_m, 100.0 * pair.seen_through);
  return words;
}

Start start_of(const Node& target, const Node& source) {
  const auto both = [&](Node::By by) { return target.by == by && source.by == by; };
  if (both(Node::By::search)) return Start::found;
  return both(Node::By::control) ? Start::surveyed : Start::guess;
}

/// The nearest few, the nearest first.
std::vector<std::size_t> near_nodes(const std::vector<Node>& nodes, std::size_t node, double most_m) {
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const double distance = distance_between_m(nodes[node].start, nodes[j].start);
    if (node != j && distance <= most_m) near.emplace_back(distance, j);
  }
  std::sort(near.begin(), near.end());
  if (near.size() > most_pairs_a_scan) near.resize(most_pairs_a_scan);
  std::vector<std::size_t> indices;
  for (const auto& [distance, j] : near) indices.push_back(j);
  return indices;
}

bool overlap_at_start(const Node& target, const Node& source, const RegistrationOptions& options) {
  const Pose guess = target.start.inverse() * source.start;
  const double loose_m = 1.0 + options.guess_sigma_m;
  const double overlap = overlap_at(*target.prepared, *source.prepared, guess, loose_m);
  const double reverse = overlap_at(*source.prepared, *target.prepared, guess.inverse(), loose_m);
  return std::max(overlap, reverse) >= options.least_overlap;
}

}  // namespace

std::vector<Candidate> candidate_pairs(const std::vector<Node>& nodes, const RegistrationOptions& options) {
  std::set<std::pair<std::size_t, std::size_t>> chosen;
  std::vector<std::size_t> nearest(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::vector<std::size_t> near = near_nodes(nodes, i, options.pair_distance_m);
    nearest[i] = near.empty() ? i : near.front();
    for (const std::size_t j : near) chosen.insert(std::minmax(i, j));
  }
  std::vector<Candidate> pairs;
  std::vector<bool> paired(nodes.size(), false);
  for (const auto& [i, j] : chosen) {
    if (!overlap_at_start(nodes[i], nodes[j], options)) continue;
    pairs.push_back({i, j});
    paired[i] = paired[j] = true;
  }
  // A scan that overlaps none where its guess puts it is asked with its nearest: the guess may be turned about.
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto [target, source] = std::minmax(i, nearest[i]);
    const Candidate lonely{target, source};
    if (paired[i] || nearest[i] == i || std::find(pairs.begin(), pairs.end(), lonely) != pairs.end()) continue;
    pairs.push_back(lonely);
  }
  return pairs;
}

bool lies_well(const PairResult& pair) {
  constexpr double least_worth = 0.45, most_noises = 5.0;
  if (pair.noise_m > 0.0 && pair.median_m > most_noises * pair.noise_m) return false;
  return FitCheck{0.0, pair.agreeing, pair.seen_through}.worth() >= least_worth;
}

PairResult matched_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                        const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress) {
  PairResult pair = register_pair(target, source, guess, start, axis_in_target, options, progress);
  if (start == Start::found || lies_well(pair)) return pair;
  const PairFound other = found_place(target, source, options, progress);
  if (other.outcome != SearchOutcome::placed) return pair;
  return register_pair(target, source, other.target_from_source, Start::found, axis_in_target, options, progress);
}

MatchedPairs register_pairs(const std::vector<Node>& nodes, std::vector<Candidate> candidates,
                            const RegistrationContext& context, const RegistrationOptions& options,
                            Progress& progress) {
  std::vector<Progress> parts;
  for (const auto& c : candidates)
    parts.push_back(
        progress.part(1.0 / static_cast<double>(candidates.size()),
                      "matching " + nodes[c.source].prepared->name + " with " + nodes[c.target].prepared->name));
  std::vector<PairResult> results(candidates.size());
  parallel_for_each_index(
      candidates.size(),
      [&](std::size_t k) {
        const double begun_s = context.clock_s ? context.clock_s() : 0.0;
        const Node& target = nodes[candidates[k].target];
        const Node& source = nodes[candidates[k].source];
        const Eigen::Vector3d axis = target.start.linear().transpose() * axis_at(context, target, target.start);
        results[k] = matched_pair(*target.prepared, *source.prepared, target.start.inverse() * source.start,
                                  start_of(target, source), axis, options, parts[k]);
        results[k].seconds = context.clock_s ? context.clock_s() - begun_s : 0.0;
        results[k].why_not = why_not(results[k], options);
        results[k].used = results[k].why_not.empty();
      },
      1);
  return {std::move(candidates), std::move(results)};
}

MatchedPairs register_moved(const std::vector<Node>& nodes, const std::vector<bool>& moved, MatchedPairs before,
                            const RegistrationContext& context, const RegistrationOptions& options,
                            Progress& progress) {
  MatchedPairs kept;
  for (std::size_t k = 0; k < before.candidates.size(); ++k) {
    const PairResult& pair = before.results[k];
    const bool touched = moved[before.candidates[k].target] || moved[before.candidates[k].source];
    if (touched && !(pair.used && pair.undetermined.empty())) continue;
    kept.candidates.push_back(before.candidates[k]);
    kept.results.push_back(pair);
  }
  const auto is_kept = [&](const Candidate& candidate) {
    return std::find(kept.candidates.begin(), kept.candidates.end(), candidate) != kept.candidates.end();
  };
  std::vector<Candidate> open = candidate_pairs(nodes, options);
  std::erase_if(open, is_kept);
  const MatchedPairs again = register_pairs(nodes, std::move(open), context, options, progress);
  kept.candidates.insert(kept.candidates.end(), again.candidates.begin(), again.candidates.end());
  kept.results.insert(kept.results.end(), again.results.begin(), again.results.end());
  return kept;
}

}  // namespace adit
