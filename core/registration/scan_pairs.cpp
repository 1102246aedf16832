#include "core/registration/scan_pairs.h"

#include <algorithm>
#include <cstdio>
#include <set>
#include <utility>

#include "core/foundation/parallel.h"
#include "core/registration/found_place.h"
#include "core/registration/pair_sheet.h"

namespace adit {
namespace {

constexpr std::size_t most_pairs_a_scan = 4;

std::string why_not(const PairResult& pair, const RegistrationOptions& options) {
  char words[120];
  if (pair.overlap < options.least_overlap) {
    std::snprintf(words, sizeof words, "overlaps by only %.0f %%", 100.0 * pair.overlap);
    return words;
  }
  if (pair.agreeing >= least_agreeing) return {};
  std::snprintf(words, sizeof words, "lies on the same surfaces with only %.0f %% of what both show",
                100.0 * pair.agreeing);
  return words;
}

Start start_of(const Node& target, const Node& source) {
  const auto both = [&](Node::By by) { return target.by == by && source.by == by; };
  if (both(Node::By::search)) return Start::found;
  return both(Node::By::control) ? Start::surveyed : Start::guess;
}

}  // namespace

std::vector<Candidate> candidate_pairs(const std::vector<Node>& nodes, const RegistrationOptions& options) {
  std::set<std::pair<std::size_t, std::size_t>> chosen;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const double distance = distance_between_m(nodes[i].start, nodes[j].start);
      if (i != j && distance <= options.pair_distance_m) near.emplace_back(distance, j);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > most_pairs_a_scan) near.resize(most_pairs_a_scan);
    for (const auto& [distance, j] : near) chosen.insert(std::minmax(i, j));
  }
  std::vector<Candidate> pairs;
  for (const auto& [i, j] : chosen) {
    const Pose guess = nodes[i].start.inverse() * nodes[j].start;
    const double loose_m = 1.0 + options.guess_sigma_m;
    const double overlap = overlap_at(*nodes[i].prepared, *nodes[j].prepared, guess, loose_m);
    const double reverse = overlap_at(*nodes[j].prepared, *nodes[i].prepared, guess.inverse(), loose_m);
    if (std::max(overlap, reverse) >= options.least_overlap) pairs.push_back({i, j});
  }
  return pairs;
}

PairResult matched_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                        const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress) {
  PairResult pair = register_pair(target, source, guess, start, axis_in_target, options, progress);
  if (start == Start::found || pair.agreeing >= least_agreeing) return pair;
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
