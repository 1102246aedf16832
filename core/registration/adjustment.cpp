#include "core/registration/adjustment.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace adit {
namespace {

constexpr double wrong_pair_misfit = 400.0;  // twenty of the pair's own sigmas: its model errors are a few
constexpr double wrong_sight_misfit = 49.0;  // seven of its sigmas: those of right pictures hold
constexpr double observation_cost = 8.0;     // a suspect with more observations has to explain more
constexpr double clear_cost = 30.0;          // by this much the best suspect must be better than the next
constexpr std::size_t least_control_points = 3;

/// Of the graph that was solved.
bool consistent(const PoseGraphResult& solved, const PoseGraph& graph) {
  for (std::size_t k = 0; k < graph.control.size(); ++k)
    if (solved.control_residual_m[k].norm() > wrong_control_sigmas * graph.sigma_of_m(graph.control[k])) return false;
  return std::none_of(solved.pair_misfit.begin(), solved.pair_misfit.end(),
                      [](double misfit) { return misfit >= wrong_pair_misfit; }) &&
         std::none_of(solved.sight_misfit.begin(), solved.sight_misfit.end(),
                      [](double misfit) { return misfit >= wrong_sight_misfit; });
}

std::vector<Suspect> all_suspects(const PoseGraph& graph, const Adjustment& adjustment) {
  std::vector<Suspect> suspects;
  for (std::size_t k = 0; k < graph.pairs.size(); ++k)
    if (adjustment.pair_used[k]) suspects.push_back({Suspect::Kind::pair, {k}, {}, {}});
  for (std::size_t k = 0; k < graph.sights.size(); ++k)
    if (adjustment.sight_used[k]) suspects.push_back({Suspect::Kind::sight, {}, {}, {k}});
  std::map<std::string, std::vector<std::size_t>> of_point;
  std::map<std::size_t, std::vector<std::size_t>> of_scan;
  for (std::size_t k = 0; k < graph.control.size(); ++k) {
    if (!adjustment.control_used[k]) continue;
    suspects.push_back({Suspect::Kind::observation, {}, {k}, {}});
    of_point[graph.control[k].id].push_back(k);
    of_scan[graph.control[k].node].push_back(k);
  }
  for (const auto& [id, members] : of_point)
    if (members.size() > 1) suspects.push_back({Suspect::Kind::point, {}, members, {}});
  for (const auto& [node, members] : of_scan)
    if (members.size() > 1) suspects.push_back({Suspect::Kind::scan, {}, members, {}});
  return suspects;
}

void leave_out(Adjustment& adjustment, const Suspect& suspect) {
  for (const std::size_t k : suspect.pairs) adjustment.pair_used[k] = false;
  for (const std::size_t k : suspect.control) adjustment.control_used[k] = false;
  for (const std::size_t k : suspect.sights) adjustment.sight_used[k] = false;
}

/// A sight ties all by itself.
bool enough_control(const PoseGraph& graph, const Adjustment& adjustment) {
  const auto& sights = adjustment.sight_used;
  if (std::find(sights.begin(), sights.end(), true) != sights.end()) return true;
  if (!sights.empty() && graph.control.empty()) return false;
  std::set<std::string> all, left;
  for (std::size_t k = 0; k < graph.control.size(); ++k) {
    all.insert(graph.control[k].id);
    if (adjustment.control_used[k]) left.insert(graph.control[k].id);
  }
  return left.size() >= std::min(all.size(), least_control_points);
}

struct Trial {
  Suspect suspect;
  std::vector<Pose> local_from_scan;  ///< without it
  double cost = 0.0;                  ///< what stays unexplained without the suspect, and what it costs to leave it out
  bool ends_it = false;
  bool permitted = false;
};

std::vector<Trial> trials(const PoseGraph& graph, const Adjustment& adjustment, Progress& progress) {
  std::vector<Trial> tried;
  const std::vector<Suspect> suspects = all_suspects(graph, adjustment);
  for (const Suspect& suspect : suspects) {
    progress.step(tried.size(), suspects.size());
    Adjustment without = adjustment;
    leave_out(without, suspect);
    PoseGraph part = used_part(graph, without);
    part.with_covariance = false;
    const PoseGraphResult solved = solve_pose_graph(part, progress);
    const auto observations =
        static_cast<double>(suspect.pairs.size() + suspect.control.size() + suspect.sights.size());
    tried.push_back({suspect, solved.local_from_scan, solved.cost + observation_cost * observations,
                     consistent(solved, part), enough_control(graph, without)});
  }
  std::stable_sort(tried.begin(), tried.end(), [](const Trial& a, const Trial& b) { return a.cost < b.cost; });
  return tried;
}

/// How far a suspect lies from where the adjustment without it puts it, and how it is turned there.
std::pair<double, double> off_from(const Trial& trial, const PoseGraph& graph) {
  double off_m = 0.0, turned_rad = 0.0;
  for (const std::size_t k : trial.suspect.pairs) {
    const GraphPair& pair = graph.pairs[k];
    const Pose others = trial.local_from_scan[pair.target].inverse() * trial.local_from_scan[pair.source];
    off_m = std::max(off_m, distance_between_m(others, pair.target_from_source));
    turned_rad = std::max(turned_rad, rotation_between_rad(others, pair.target_from_source));
  }
  for (const std::size_t k : trial.suspect.control) {
    const GraphControl& c = graph.control[k];
    off_m = std::max(off_m, (trial.local_from_scan[c.node] * c.in_scan - c.in_local).norm());
  }
  for (const std::size_t k : trial.suspect.sights) {
    const GraphSight& sight = graph.sights[k];
    const Pose others = trial.local_from_scan[sight.node] * graph.cameras[sight.camera].scan_from_camera;
    off_m = std::max(off_m, distance_between_m(others, sight.local_from_camera));
    turned_rad = std::max(turned_rad, rotation_between_rad(others, sight.local_from_camera));
  }
  return {off_m, turned_rad};
}

/// True when leaving out b leaves out a, too: then b explains nothing that a does not.
bool holds(const Suspect& b, const Suspect& a) {
  const auto within = [](const std::vector<std::size_t>& inner, const std::vector<std::size_t>& outer) {
    return std::includes(outer.begin(), outer.end(), inner.begin(), inner.end());
  };
  return within(a.pairs, b.pairs) && within(a.control, b.control) && within(a.sights, b.sights);
}

/// One step: something is left out, or the contradiction stays and is named. False when it stays.
bool settle_one(const PoseGraph& graph, Adjustment& adjustment, Progress& progress) {
  const std::vector<Trial> tried = trials(graph, adjustment, progress);
  if (tried.empty()) return false;
  const Trial& best = tried.front();
  Contradiction contradiction;
  contradiction.suspects.push_back(best.suspect);
  for (std::size_t i = 1; best.ends_it && i < tried.size(); ++i) {
    const Trial& other = tried[i];
    if (other.ends_it && other.cost < best.cost + clear_cost && !holds(other.suspect, best.suspect))
      contradiction.suspects.push_back(other.suspect);
  }
  contradiction.left_out = best.permitted && contradiction.suspects.size() == 1;
  std::tie(contradiction.off_m, contradiction.turned_rad) = off_from(best, graph);
  if (contradiction.left_out) leave_out(adjustment, best.suspect);
  adjustment.contradictions.push_back(contradiction);
  return contradiction.left_out;
}

}  // namespace

PoseGraph used_part(const PoseGraph& graph, const Adjustment& adjustment) {
  PoseGraph part = graph;
  part.pairs.clear();
  part.control.clear();
  part.sights.clear();
  for (std::size_t k = 0; k < graph.pairs.size(); ++k)
    if (adjustment.pair_used[k]) part.pairs.push_back(graph.pairs[k]);
  for (std::size_t k = 0; k < graph.control.size(); ++k)
    if (adjustment.control_used[k]) part.control.push_back(graph.control[k]);
  for (std::size_t k = 0; k < graph.sights.size(); ++k)
    if (adjustment.sight_used[k]) part.sights.push_back(graph.sights[k]);
  if (!part.is_tied()) part.datum = graph.datum.value_or(0);
  return part;
}

Adjustment adjusted(const PoseGraph& graph, Progress& progress) {
  Adjustment adjustment;
  adjustment.pair_used.assign(graph.pairs.size(), true);
  adjustment.control_used.assign(graph.control.size(), true);
  adjustment.sight_used.assign(graph.sights.size(), true);
  for (double share = 0.3;; share *= 0.7) {  // of the progress: nobody knows how many turns it takes
    const PoseGraph used = used_part(graph, adjustment);
    adjustment.solved = solve_pose_graph(used, progress);
    if (consistent(adjustment.solved, used)) return adjustment;
    Progress turn = progress.part(share, "looking for what contradicts the rest");
    if (!settle_one(graph, adjustment, turn)) return adjustment;
  }
}

}  // namespace adit
