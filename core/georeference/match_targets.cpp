#include "core/georeference/match_targets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

constexpr double most_sigmas = 4.0;
constexpr std::size_t least_matched = 3;

using Assignment = std::vector<std::optional<std::size_t>>;

struct Matching {
  const std::vector<UnnamedTarget>& seen;
  const std::vector<ControlPoint>& control;
  const std::optional<Pose>& guess;
  const MatchOptions& options;

  double near_m(std::size_t target) const {
    return most_sigmas * std::hypot(seen[target].sigma_m, options.control_sigma_m);
  }
  bool may_be(std::size_t target, std::size_t point) const {
    if (!seen[target].id.empty() && seen[target].id != control[point].id) return false;
    if (!guess) return true;
    // No pose that agrees with the guess brings it farther.
    const double reach_m =
        near_m(target) + most_sigmas * (options.guess_sigma_m + seen[target].in_scan.norm() * options.guess_sigma_rad);
    return (*guess * seen[target].in_scan - control[point].position).norm() <= reach_m;
  }
  bool keeps_distance(std::size_t i, std::size_t j, std::size_t a, std::size_t b) const {
    const double seen_m = (seen[i].in_scan - seen[j].in_scan).norm();
    const double surveyed_m = (control[a].position - control[b].position).norm();
    return std::abs(seen_m - surveyed_m) <= std::hypot(near_m(i), near_m(j));
  }
  bool agrees_with_guess(const Pose& pose) const {
    // A scanner stands upright: lying or upside down, it is control points in a mirror (east and north exchanged, or a
    // sign) that fit.
    constexpr double least_upright = 0.94;  // cosine of 20 degrees
    if (!guess) return pose.linear()(2, 2) > least_upright;
    return distance_between_m(pose, *guess) <= most_sigmas * options.guess_sigma_m &&
           rotation_between_rad(pose, *guess) <= most_sigmas * options.guess_sigma_rad;
  }
};

/// Each target to the nearest control point it lies on, each point once: nearest pairs first.
Assignment assigned(const Matching& matching, const Pose& pose, double loose) {
  struct Pair {
    double off;
    std::size_t target, point;
  };
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < matching.seen.size(); ++i)
    for (std::size_t a = 0; a < matching.control.size(); ++a) {
      const double off_m = (pose * matching.seen[i].in_scan - matching.control[a].position).norm();
      if (matching.may_be(i, a) && off_m <= loose * matching.near_m(i)) pairs.push_back({off_m, i, a});
    }
  std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.off < b.off; });
  Assignment result(matching.seen.size());
  std::vector<bool> taken(matching.control.size(), false);
  for (const Pair& pair : pairs)
    if (!result[pair.target] && !taken[pair.point]) {
      result[pair.target] = pair.point;
      taken[pair.point] = true;
    }
  return result;
}

std::optional<Pose> pose_of(const Matching& matching, const Assignment& assignment) {
  std::vector<Eigen::Vector3d> source, target;
  for (std::size_t i = 0; i < assignment.size(); ++i)
    if (assignment[i]) {
      source.push_back(matching.seen[i].in_scan);
      target.push_back(matching.control[*assignment[i]].position);
    }
  return fit_rigid(source, target);
}

std::size_t count_of(const Assignment& assignment) {
  return static_cast<std::size_t>(
      std::count_if(assignment.begin(), assignment.end(), [](const auto& point) { return point.has_value(); }));
}

/// From three pairs to all: loosely first, for a small triangle turns far targets.
Assignment grown(const Matching& matching, const std::array<std::size_t, 3>& targets,
                 const std::array<std::size_t, 3>& points) {
  constexpr double looser[] = {4.0, 2.0, 1.0, 1.0};
  Assignment assignment(matching.seen.size());
  for (std::size_t k = 0; k < 3; ++k) assignment[targets[k]] = points[k];
  auto pose = pose_of(matching, assignment);
  for (const double loose : looser) {
    if (!pose) return Assignment(matching.seen.size());
    assignment = assigned(matching, *pose, loose);
    pose = pose_of(matching, assignment);
  }
  return pose && matching.agrees_with_guess(*pose) ? assignment : Assignment(matching.seen.size());
}

/// Triples of targets, wide ones first: they leave least open.
std::vector<std::array<std::size_t, 3>> triples_of(const std::vector<UnnamedTarget>& seen) {
  constexpr std::size_t most_triples = 1500;
  std::vector<std::array<std::size_t, 3>> triples;
  std::vector<double> area;
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = i + 1; j < seen.size(); ++j)
      for (std::size_t k = j + 1; k < seen.size(); ++k) triples.push_back({i, j, k});
  const auto area_of = [&](const std::array<std::size_t, 3>& t) {
    return (seen[t[1]].in_scan - seen[t[0]].in_scan).cross(seen[t[2]].in_scan - seen[t[0]].in_scan).norm();
  };
  std::stable_sort(triples.begin(), triples.end(),
                   [&](const auto& a, const auto& b) { return area_of(a) > area_of(b); });
  if (triples.size() > most_triples) triples.resize(most_triples);
  return triples;
}

/// Ways to match that were found, each once.
void keep(const Assignment& assignment, std::vector<Assignment>& ways) {
  if (count_of(assignment) >= least_matched && std::find(ways.begin(), ways.end(), assignment) == ways.end())
    ways.push_back(assignment);
}

/// Whether two ways take a target for different points: one that only leaves a target out is no other way.
bool contradict(const Assignment& a, const Assignment& b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i] && *a[i] != *b[i]) return true;
  // Or none in common: they stand in different places altogether.
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] && b[i]) return false;
  return true;
}

}  // namespace

TargetMatch match_targets(const std::vector<UnnamedTarget>& seen, const std::vector<ControlPoint>& control,
                          const std::optional<Pose>& local_from_scan_guess, const MatchOptions& options,
                          Progress& progress) {
  const Matching matching{seen, control, local_from_scan_guess, options};
  std::vector<Assignment> ways;
  for (const auto& [i, j, k] : triples_of(seen)) {
    progress.check();
    for (std::size_t a = 0; a < control.size(); ++a) {
      if (!matching.may_be(i, a)) continue;
      for (std::size_t b = 0; b < control.size(); ++b) {
        if (a == b || !matching.may_be(j, b) || !matching.keeps_distance(i, j, a, b)) continue;
        for (std::size_t c = 0; c < control.size(); ++c)
          if (c != a && c != b && matching.may_be(k, c) && matching.keeps_distance(i, k, a, c) &&
              matching.keeps_distance(j, k, b, c))
            keep(grown(matching, {i, j, k}, {a, b, c}), ways);
      }
    }
  }
  TargetMatch match;
  match.control.assign(seen.size(), std::nullopt);
  const auto fewer = [](const Assignment& a, const Assignment& b) { return count_of(a) < count_of(b); };
  const auto best = std::max_element(ways.begin(), ways.end(), fewer);
  if (best == ways.end()) return match;
  match.ambiguous = std::any_of(ways.begin(), ways.end(), [&](const Assignment& other) {
    return count_of(other) == count_of(*best) && contradict(other, *best);
  });
  if (match.ambiguous) return match;
  match.control = *best;
  match.local_from_scan = pose_of(matching, *best);
  match.matched = count_of(*best);
  return match;
}

}  // namespace adit
