#include "core/registration/pair_search.h"

#include <algorithm>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/registration/ndt_score.h"
#include "core/registration/newton.h"

namespace adit {
namespace {

/// The best few by check are followed in cells of this size.
struct Stage {
  double cell_m;
  std::size_t most;
  double near_m;  ///< for the check: what the cells before may be off
};

/// Descends from all of them in cells of one size, best first; those that end at the same place are one.
std::vector<Pose> descended(const PreparedScan& target, const PreparedScan& source, const std::vector<Pose>& starts,
                            double cell_m, const Progress& progress) {
  const DistributionMap& cells = target.pyramid.levels[target.pyramid.level_near(cell_m)];
  const auto& sources = source.pyramid.levels[source.pyramid.level_near(0.5 * cells.cell_m())].distributions();
  NewtonOptions newton;
  newton.most_iterations = 15;
  newton.longest_step_m = 0.5 * cells.cell_m();
  newton.least_step_m = 0.02 * cells.cell_m();
  std::vector<NewtonResult> ends(starts.size());
  parallel_for_each_index(
      starts.size(),
      [&](std::size_t i) {
        Progress silent;
        progress.check();
        ends[i] = descend(
            starts[i], [&](const Pose& at) { return ndt_score(cells, sources, at, {}, silent); }, newton);
      },
      1);
  std::stable_sort(ends.begin(), ends.end(),
                   [](const NewtonResult& a, const NewtonResult& b) { return a.at.score < b.at.score; });
  std::vector<Pose> kept;
  for (const NewtonResult& end : ends) {
    const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Pose& other) {
      return distance_between_m(end.pose, other) < 0.2 * cells.cell_m() &&
             rotation_between_rad(end.pose, other) < rad_from_deg(3.0);
    });
    if (is_new) kept.push_back(end.pose);
  }
  return kept;
}

/// Best first.
std::vector<PairPlace> checked(const PreparedScan& target, const PreparedScan& source, const std::vector<Pose>& poses,
                               double near_m) {
  std::vector<PairPlace> places(poses.size());
  parallel_for_each_index(
      poses.size(),
      [&](std::size_t i) {
        places[i] = {poses[i], check_fit(target, source, poses[i], near_m)};
      },
      1);
  std::stable_sort(places.begin(), places.end(),
                   [](const PairPlace& a, const PairPlace& b) { return a.check.worth() > b.check.worth(); });
  return places;
}

std::vector<Pose> best_checked(const PreparedScan& target, const PreparedScan& source, const std::vector<Pose>& poses,
                               const Stage& stage) {
  std::vector<Pose> best;
  for (const PairPlace& place : checked(target, source, poses, stage.near_m))
    if (best.size() < stage.most) best.push_back(place.target_from_source);
  return best;
}

}  // namespace

std::vector<PairPlace> search_pair(const PreparedScan& target, const PlanView& target_plan, const PreparedScan& source,
                                   const PlanView& source_plan, const PairSearchOptions& options, Progress& progress) {
  std::vector<Pose> some;
  for (const PlanMatch& match : plan_matches(target_plan, source_plan, options.reach_m, options.most_starts))
    some.push_back(match.target_from_source);
  for (const double cell_m : {3.2, 1.6}) some = descended(target, source, some, cell_m, progress);
  // The score favours much overlap, a right place may have little: from here on only the check chooses.
  for (const Stage stage : {Stage{0.8, 14, 0.05}, Stage{0.4, 4, 0.03}})
    some = descended(target, source, best_checked(target, source, some, stage), stage.cell_m, progress);
  return checked(target, source, some, 0.02);
}

}  // namespace adit
