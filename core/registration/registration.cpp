#include "core/registration/registration.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "core/foundation/angle.h"
#include "core/registration/adjustment.h"
#include "core/registration/control_findings.h"
#include "core/registration/joint_refinement.h"
#include "core/registration/loops.h"
#include "core/registration/observability.h"
#include "core/registration/picture_findings.h"
#include "core/registration/registration_findings.h"
#include "core/registration/scan_pairs.h"
#include "core/registration/wrong_guesses.h"

namespace adit {
namespace {

PoseGraph graph_of(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                   const std::vector<PairResult>& pairs, const RegistrationContext& context,
                   const RegistrationOptions& options) {
  PoseGraph graph;
  graph.guess_sigma_m = options.guess_sigma_m;
  graph.guess_sigma_rad = rad_from_deg(options.guess_sigma_deg);
  graph.control_sigma_m = options.control_sigma_m;
  const auto datum = std::find_if(nodes.begin(), nodes.end(), [](const Node& n) { return n.by == Node::By::guess; });
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    graph.local_from_scan.push_back(nodes[i].start);
    graph.guessed.push_back(nodes[i].by == Node::By::guess);
    for (GraphControl control : nodes[i].control) {
      control.node = i;
      graph.control.push_back(control);
    }
    for (GraphSight sight : nodes[i].sights) {
      sight.node = i;
      graph.sights.push_back(sight);
    }
  }
  for (const RigCamera& camera : context.cameras)
    graph.cameras.push_back({camera.scan_from_camera, camera.sigma_m, camera.sigma_rad});
  if (!graph.is_tied()) graph.datum = datum == nodes.end() ? 0 : static_cast<std::size_t>(datum - nodes.begin());
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs[k].used)
      graph.pairs.push_back(
          {candidates[k].source, candidates[k].target, pairs[k].target_from_source, pairs[k].information});
  return graph;
}

/// Nodes that pairs, control or pictures tie to the datum.
std::vector<bool> tied_nodes(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                             const std::vector<PairResult>& pairs, std::optional<std::size_t> datum) {
  std::vector<bool> tied(nodes.size(), false);
  bool any_placed = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    tied[i] = nodes[i].is_placed();
    any_placed = any_placed || tied[i];
  }
  if (!any_placed) tied[datum.value_or(0)] = true;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (!pairs[k].used || tied[candidates[k].source] == tied[candidates[k].target]) continue;
      tied[candidates[k].source] = tied[candidates[k].target] = true;
      changed = true;
    }
  }
  return tied;
}

/// Of each node the first one that used pairs tie it to, by whichever way.
std::vector<std::size_t> groups_of(std::size_t nodes, const std::vector<Candidate>& candidates,
                                   const std::vector<PairResult>& pairs) {
  std::vector<std::size_t> group(nodes);
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      std::size_t& a = group[candidates[k].source];
      std::size_t& b = group[candidates[k].target];
      if (!pairs[k].used || a == b) continue;
      a = b = std::min(a, b);
      changed = true;
    }
  }
  return group;
}

std::string how_placed(const Node& node, bool has_pairs, bool is_datum) {
  const bool control = has_pairs ? !node.control.empty() : node.control.size() >= least_targets;
  if (is_datum && !control) return "datum";
  std::vector<std::string> by;
  if (has_pairs) by.emplace_back("clouds");
  if (control) by.emplace_back("control");
  if (!node.sights.empty()) by.emplace_back("pictures");
  if (by.size() == 3) return "clouds, control and pictures";
  if (by.size() == 2) return by[0] + " and " + by[1];
  return by.empty() ? "guess" : by[0];
}

/// What nothing ties has a sigma as large as numbers go: 100 m and 180 degrees say the same.
PoseSigma no_more_than_unknown(const PoseSigma& sigma) {
  constexpr double most_m = 100.0;
  return {std::min(sigma.along_m, most_m), std::min(sigma.across_m, most_m), std::min(sigma.up_m, most_m),
          std::min(sigma.roll_rad, pi),    std::min(sigma.pitch_rad, pi),    std::min(sigma.yaw_rad, pi)};
}

void place_nodes(RegistrationResult& result, const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                 const PoseGraph& graph, const PoseGraphResult& solved, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  report_untied(result, nodes, tied_nodes(nodes, candidates, result.pairs, graph.datum),
                groups_of(nodes.size(), candidates, result.pairs));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    PlacedScan& scan = result.scans[nodes[i].scan];
    bool has_pairs = false, knows_all = true;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (!result.pairs[k].used || (candidates[k].source != i && candidates[k].target != i)) continue;
      if (result.pairs[k].undetermined.size() == std::size(direction_names)) continue;  // says nothing
      has_pairs = true;
      knows_all = knows_all && result.pairs[k].undetermined.empty();
    }
    scan.placed = true;
    scan.local_from_scan = solved.local_from_scan[i];
    scan.sigma =
        no_more_than_unknown(sigma_in_axes(result.sigma_factor * result.sigma_factor * solved.covariance[i],
                                           tunnel_axes(axis_at(context, nodes[i], solved.local_from_scan[i]))));
    scan.placed_by = how_placed(nodes[i], has_pairs, graph.datum == i);
    if (graph.datum == i) compare_datum_with_guesses(scan, solved.moved_from_guesses, options, result.findings);
    const bool guessed = nodes[i].by == Node::By::guess && !(has_pairs && knows_all);
    name_undetermined(scan, guessed, options, result.findings);
    if (graph.datum != i) compare_with_guess(scan, nodes[i], solved.moved_from_guesses, options, result.findings);
  }
}

/// How many directions a pair knows to a metre or a radian: held ones are known to a hundred.
int known_directions(const GraphPair& pair) {
  const auto values = Eigen::SelfAdjointEigenSolver<Matrix6d>(pair.information, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<int>((values.array() > 1.0).count());
}

/// Observations less unknowns. A scan that nothing ties has no unknowns, one that little ties not all six: it checks
/// nothing, and so it must not make the others look better known.
int redundancy_of(const PoseGraph& used) {
  int observations = 3 * static_cast<int>(used.control.size()) + 6 * static_cast<int>(used.sights.size());
  std::vector<int> of_node(used.local_from_scan.size(), 0);
  for (const GraphPair& pair : used.pairs) {
    const int known = known_directions(pair);
    observations += known;
    of_node[pair.source] += known;
    of_node[pair.target] += known;
  }
  for (const GraphControl& control : used.control) of_node[control.node] += 3;
  for (const GraphSight& sight : used.sights) of_node[sight.node] += 6;
  int unknowns = 0;
  for (std::size_t i = 0; i < of_node.size(); ++i)
    if (used.datum != i) unknowns += std::min(6, of_node[i]);
  return observations - unknowns;
}

/// Root of the variance factor of what was used, each pair by itself; 1 at least, and where nothing checks anything.
double sigma_factor_of(const PoseGraph& used, const PoseGraphResult& solved) {
  double squares = std::accumulate(solved.pair_misfit.begin(), solved.pair_misfit.end(), 0.0);
  for (std::size_t k = 0; k < used.control.size(); ++k)
    squares += std::pow(solved.control_residual_m[k].norm() / used.sigma_of_m(used.control[k]), 2);
  for (const auto& misfits : {solved.sight_misfit, solved.camera_misfit})
    squares += std::accumulate(misfits.begin(), misfits.end(), 0.0);
  const int redundancy = redundancy_of(used);
  return redundancy > 0 ? std::sqrt(std::max(1.0, squares / redundancy)) : 1.0;
}

/// Takes over what was used: pairs into the result, and only the control and pictures that were used stay with the
/// nodes.
void keep_used(RegistrationResult& result, std::vector<Node>& nodes, const Adjustment& adjustment,
               const PoseGraph& graph) {
  std::size_t k = 0;
  for (PairResult& pair : result.pairs)
    if (pair.used && !adjustment.pair_used[k++]) {
      pair.used = false;
      pair.why_not = "contradicts the other observations";
    }
  for (Node& node : nodes) {
    node.control.clear();
    node.sights.clear();
  }
  for (std::size_t c = 0; c < graph.sights.size(); ++c)
    if (adjustment.sight_used[c]) nodes[graph.sights[c].node].sights.push_back(graph.sights[c]);
  for (std::size_t c = 0; c < graph.control.size(); ++c)
    if (adjustment.control_used[c]) nodes[graph.control[c].node].control.push_back(graph.control[c]);
}

/// Of the pairs that know every direction: the others were told by guesses. pairs: those of the graphs, in their order.
std::vector<GraphPair> knowing_pairs(const PoseGraph& graph, const std::vector<PairResult>& pairs) {
  std::vector<GraphPair> knowing;
  std::size_t k = 0;
  for (const PairResult& pair : pairs) {
    if (!pair.used) continue;
    if (pair.undetermined.empty()) knowing.push_back(graph.pairs[k]);
    ++k;
  }
  return knowing;
}

std::vector<LoopClosure> loop_closures(const std::vector<GraphPair>& before, const std::vector<GraphPair>& after,
                                       const std::vector<Node>& nodes) {
  std::vector<LoopClosure> closures;
  for (const PairLoop& loop : loops_of(nodes.size(), before)) {
    LoopClosure closure;
    for (const std::size_t node : loop.nodes) closure.scans.push_back(nodes[node].prepared->name);
    const Pose open = closure_of(loop, before);
    const Pose left = closure_of(loop, after);
    closure.before_m = open.translation().norm();
    closure.before_rad = rotation_between_rad(open, Pose::Identity());
    closure.after_m = left.translation().norm();
    closure.after_rad = rotation_between_rad(left, Pose::Identity());
    closures.push_back(closure);
  }
  return closures;
}

/// Where neither a guess nor the targets of any one scan tell, the targets of all scans together may. False, and
/// without control, where nothing does: the nodes then stand in a frame of their own.
bool stand_in_site(std::vector<Node>& nodes) {
  if (std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.by != Node::By::search; })) return true;
  std::vector<Eigen::Vector3d> seen, points;
  for (const Node& node : nodes)
    for (const GraphControl& control : node.control) {
      seen.push_back(node.start * control.in_scan);
      points.push_back(control.in_local);
    }
  const auto site_from_group = fit_rigid(seen, points);
  for (Node& node : nodes) {
    if (site_from_group) node.start = *site_from_group * node.start;
    if (!site_from_group) node.control.clear();
  }
  return site_from_group.has_value();
}

/// Matches all pairs, and those of scans whose guesses turn out wrong once more from where they stand.
MatchedPairs matched_pairs(std::vector<Node>& nodes, const RegistrationContext& context,
                           const RegistrationOptions& options, Findings& findings, Progress& progress) {
  constexpr int most_rounds = 3;  // a pair that was no candidate before may contradict the next guess
  const std::vector<Node> guessed = nodes;
  Progress matching = progress.part(0.25, "matching scans");
  MatchedPairs pairs = register_pairs(nodes, candidate_pairs(nodes, options), context, options, matching);
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<bool> moved = set_aside_wrong_guesses(nodes, pairs, options);
    if (std::find(moved.begin(), moved.end(), true) == moved.end()) break;
    std::vector<bool> searched;
    for (const Node& node : nodes) searched.push_back(node.by == Node::By::search);
    Progress again = progress.part(0.05 / most_rounds, "matching scans again");
    pairs = register_moved(nodes, searched, std::move(pairs), context, options, again);
  }
  take_back_right_guesses(guessed, nodes, options);
  report_wrong_guesses(guessed, nodes, findings);
  return pairs;
}

}  // namespace

RegistrationResult register_scans(const std::vector<ScanToPlace>& scans, const RegistrationContext& known,
                                  const RegistrationOptions& options, Progress& progress) {
  check_targets(scans, known);
  RegistrationResult result;
  for (const auto& scan : scans) {
    result.scans.emplace_back();
    result.scans.back().name = scan.name;
    result.scans.back().placed_by = "not placed";
  }
  Progress preparing = progress.part(0.2, "preparing scans");
  const PreparedScans prepared = prepare_scans(scans, options, result.findings, preparing);
  Progress placing = progress.part(0.4, "placing scans");
  std::vector<Node> nodes = starting_nodes(scans, prepared, known, options, result.findings, placing);
  result.in_site = stand_in_site(nodes);
  RegistrationContext context = known;
  if (!result.in_site) context.axis_direction = nullptr;  // the design's axis lies in the site
  const MatchedPairs pairs = matched_pairs(nodes, context, options, result.findings, progress);
  const std::vector<Candidate>& candidates = pairs.candidates;
  result.pairs = pairs.results;
  report_pairs(result, options);
  Progress adjusting = progress.part(0.1, "adjusting all scans");
  const PoseGraph graph = graph_of(nodes, candidates, result.pairs, context, options);
  const Adjustment adjustment = adjusted(graph, adjusting);
  report_contradictions(result, adjustment, graph, nodes);
  keep_used(result, nodes, adjustment, graph);
  const JointRefinement joint = options.refinement == Refinement::surfaces
                                    ? refine_jointly(graph, adjustment, nodes, result.pairs, context, adjusting)
                                    : JointRefinement{used_part(graph, adjustment), adjustment.solved};
  result.sigma_factor = sigma_factor_of(used_part(graph, adjustment), adjustment.solved);
  result.loops = loop_closures(knowing_pairs(used_part(graph, adjustment), result.pairs),
                               knowing_pairs(joint.graph, result.pairs), nodes);
  report_loops(result, options);
  place_nodes(result, nodes, candidates, graph, joint.solved, context, options);
  compare_guesses_with_control(result, nodes, options);
  report_control(result, adjustment, joint.solved, graph, nodes);
  report_pictures(result, adjustment, joint.solved, graph, nodes, context);
  compare_guesses_with_pictures(result, scans, nodes, options);
  if (graph.datum) result.datum_scan = nodes[*graph.datum].prepared->name;
  judge_datum(result, nodes, known, options);
  result.accepted = std::none_of(result.findings.begin(), result.findings.end(),
                                 [](const Finding& f) { return f.severity == Severity::decision; });
  return result;
}

}  // namespace adit
