#include "core/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"
#include "core/registration/adjustment.h"
#include "core/registration/observability.h"
#include "core/registration/pose_graph.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/register_pair.h"

namespace adit {
namespace {

constexpr double least_range_m = 0.6;
constexpr double most_range_m = 45.0;
constexpr std::size_t most_pairs_a_scan = 4;
constexpr std::size_t least_targets = 3;  // place a scan without anything else

/// A scan with a starting pose; index into the caller's scans.
struct Node {
  std::size_t scan = 0;
  Pose start = Pose::Identity();
  std::string placed_by;
  std::vector<GraphControl> control;
  PreparedScan prepared;
};

std::map<std::string, Eigen::Vector3d> control_by_id(const RegistrationContext& context) {
  std::map<std::string, Eigen::Vector3d> by_id;
  for (const auto& point : context.control) by_id[point.id] = point.position;
  return by_id;
}

/// Starting pose of a scan: its guess, or the rigid fit of its targets to control.
std::optional<Node> starting_node(std::size_t index, const ScanToPlace& scan, const RegistrationContext& context) {
  const auto by_id = control_by_id(context);
  Node node;
  node.scan = index;
  std::vector<Eigen::Vector3d> seen, known;
  for (const auto& target : context.targets) {
    if (target.scan != scan.name) continue;
    const auto point = by_id.find(target.id);
    if (point == by_id.end()) continue;
    node.control.push_back({0, target.id, target.position, point->second});
    seen.push_back(target.position);
    known.push_back(point->second);
  }
  if (scan.local_from_scan_guess) {
    node.start = *scan.local_from_scan_guess;
    node.placed_by = "guess";
    return node;
  }
  if (const auto fit = fit_rigid(seen, known)) {
    node.start = *fit;
    node.placed_by = "control";
    return node;
  }
  return std::nullopt;
}

void check_names(const std::vector<ScanToPlace>& scans, const RegistrationContext& context) {
  if (scans.empty()) throw Error("there is no scan to place", "scans", "name at least one scan in the job");
  std::set<std::string> names;
  for (const auto& scan : scans) names.insert(scan.name);
  const auto by_id = control_by_id(context);
  for (const auto& target : context.targets) {
    if (names.count(target.scan) == 0)
      throw Error("target " + target.id + " belongs to scan \"" + target.scan + "\", which the job does not have",
                  "targets", "use the names of the job's scans");
  }
  for (const auto& target : context.targets) {
    if (by_id.count(target.id) == 0)
      throw Error("target " + target.id + " of scan " + target.scan + " has no control point", "targets",
                  "add " + target.id + " to the control file or remove the target");
  }
}

std::vector<Node> starting_nodes(const std::vector<ScanToPlace>& scans, const RegistrationContext& context) {
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (auto node = starting_node(i, scans[i], context)) nodes.push_back(std::move(*node));
  if (nodes.empty()) {  // nothing says where we are: the first scan is the frame
    nodes.emplace_back();
    nodes.back().placed_by = "datum";
  }
  return nodes;
}

struct Candidate {
  std::size_t target = 0;
  std::size_t source = 0;
};

/// Pairs of near stations that overlap at the guess; each scan keeps its nearest few.
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
    const double overlap = overlap_at(nodes[i].prepared, nodes[j].prepared, guess, loose_m);
    const double reverse = overlap_at(nodes[j].prepared, nodes[i].prepared, guess.inverse(), loose_m);
    if (std::max(overlap, reverse) >= options.least_overlap) pairs.push_back({i, j});
  }
  return pairs;
}

Eigen::Vector3d axis_at(const RegistrationContext& context, const std::vector<Node>& nodes,
                        const Eigen::Vector3d& where) {
  if (context.axis_direction) return context.axis_direction(where);
  // Without a design: the line through the stations, or east for a single one.
  Eigen::Vector3d direction = nodes.back().start.translation() - nodes.front().start.translation();
  direction.z() = 0.0;
  return direction.norm() > 0.1 ? Eigen::Vector3d(direction.normalized()) : Eigen::Vector3d::UnitX();
}

std::vector<PairResult> register_pairs(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                                       const RegistrationContext& context, const RegistrationOptions& options,
                                       Progress& progress) {
  std::vector<Progress> parts;
  for (const auto& c : candidates)
    parts.push_back(
        progress.part(1.0 / static_cast<double>(candidates.size()),
                      "matching " + nodes[c.source].prepared.name + " with " + nodes[c.target].prepared.name));
  std::vector<PairResult> results(candidates.size());
  parallel_for_each_index(
      candidates.size(),
      [&](std::size_t k) {
        const Node& target = nodes[candidates[k].target];
        const Node& source = nodes[candidates[k].source];
        const Eigen::Vector3d middle = 0.5 * (target.start.translation() + source.start.translation());
        const Eigen::Vector3d axis = target.start.linear().transpose() * axis_at(context, nodes, middle);
        results[k] = register_pair(target.prepared, source.prepared, target.start.inverse() * source.start, axis,
                                   options, parts[k]);
        results[k].used = results[k].overlap >= options.least_overlap;
      },
      1);
  return results;
}

PoseGraph graph_of(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                   const std::vector<PairResult>& pairs, const RegistrationOptions& options) {
  PoseGraph graph;
  graph.guess_sigma_m = options.guess_sigma_m;
  graph.guess_sigma_rad = rad_from_deg(options.guess_sigma_deg);
  graph.control_sigma_m = options.control_sigma_m;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    graph.local_from_scan.push_back(nodes[i].start);
    for (GraphControl control : nodes[i].control) {
      control.node = i;
      graph.control.push_back(control);
    }
  }
  if (graph.control.empty()) graph.datum = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs[k].used)
      graph.pairs.push_back(
          {candidates[k].source, candidates[k].target, pairs[k].target_from_source, pairs[k].information});
  return graph;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// "control point T105", "target T105 of scan S2", ...
std::string name_of(const Suspect& suspect, const PoseGraph& graph, const std::vector<Node>& nodes) {
  const auto scan_of = [&](std::size_t node) { return nodes[node].prepared.name; };
  if (suspect.kind == Suspect::Kind::pair) {
    const GraphPair& pair = graph.pairs[suspect.pairs.front()];
    return "pair " + scan_of(pair.source) + " - " + scan_of(pair.target);
  }
  const GraphControl& first = graph.control[suspect.control.front()];
  if (suspect.kind == Suspect::Kind::point) return "control point " + first.id;
  if (suspect.kind == Suspect::Kind::scan) return "targets of scan " + scan_of(first.node);
  return "target " + first.id + " of scan " + scan_of(first.node);
}

std::string mend_of(Suspect::Kind kind) {
  switch (kind) {
    case Suspect::Kind::pair:
      return "check the poses of both scans, their overlap, and whether each has the file of its station";
    case Suspect::Kind::observation:
      return "check its name and its place in the scan; it stays left out until the targets or the control are mended";
    case Suspect::Kind::point:
      return "check its coordinates in the control file, and whether it has moved";
    case Suspect::Kind::scan:
      break;
  }
  return "check whether they are filed under the wrong scan, or some of their names are exchanged";
}

void report_contradictions(RegistrationResult& result, const Adjustment& adjustment, const PoseGraph& graph,
                           const std::vector<Node>& nodes) {
  for (const Contradiction& contradiction : adjustment.contradictions) {
    std::vector<std::string> names;
    for (const Suspect& suspect : contradiction.suspects) names.push_back(name_of(suspect, graph, nodes));
    if (contradiction.left_out) {
      result.findings.push_back({Severity::decision, names.front(),
                                 "contradicts the other observations and was left out of the adjustment",
                                 mend_of(contradiction.suspects.front().kind)});
    } else if (names.size() == 1) {
      result.findings.push_back({Severity::decision, "adjustment",
                                 names.front() + " contradicts the other observations; without it too little control "
                                                 "would be left, so it stays in",
                                 "check it, or survey more targets"});
    } else {
      constexpr std::size_t most_names = 6;
      const bool many = names.size() > most_names;
      if (many) names.resize(most_names);
      result.findings.push_back({Severity::decision, "adjustment",
                                 "the observations contradict each other, and the others cannot tell which is wrong: " +
                                     listed(names) + (many ? " or others" : "") + "; nothing was left out",
                                 "check these, or survey more targets"});
    }
  }
}

/// Nodes that pairs or control tie to the datum.
std::vector<bool> tied_nodes(const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                             const std::vector<PairResult>& pairs) {
  std::vector<bool> tied(nodes.size(), false);
  bool any_control = false;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    tied[i] = nodes[i].control.size() >= least_targets;
    any_control = any_control || tied[i];
  }
  if (!any_control) tied[0] = true;
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

std::string how_placed(const Node& node, bool has_pairs, bool is_datum) {
  const bool control = !node.control.empty();
  if (has_pairs && control) return "clouds and control";
  if (is_datum) return "datum";
  if (has_pairs) return "clouds";
  if (node.control.size() >= least_targets) return "control";
  return "guess";
}

void name_undetermined(PlacedScan& scan, const RegistrationOptions& options, Findings& findings) {
  const std::pair<const char*, double> directions[] = {
      {"along", scan.sigma.along_m}, {"across", scan.sigma.across_m}, {"up", scan.sigma.up_m}};
  for (const auto& [direction, sigma_m] : directions) {
    if (sigma_m <= options.undetermined_sigma_m) continue;
    scan.undetermined.emplace_back(direction);
    char words[160];
    std::snprintf(words, sizeof words, "%s the tunnel: not determined by the clouds (sigma %.0f mm), held at the guess",
                  direction, 1000.0 * sigma_m);
    findings.push_back(
        {Severity::decision, "scan " + scan.name, words, "survey targets for this scan or add scans between"});
  }
}

/// A scan that ended far from its guess: the guess was wrong, or the match is.
void compare_with_guess(const PlacedScan& scan, const Node& node, const RegistrationOptions& options,
                        Findings& findings) {
  if (node.placed_by != "guess") return;
  const double moved_m = distance_between_m(node.start, scan.local_from_scan);
  const double turned_deg = deg_from_rad(rotation_between_rad(node.start, scan.local_from_scan));
  if (moved_m <= 3.0 * options.guess_sigma_m && turned_deg <= 3.0 * options.guess_sigma_deg) return;
  char words[200];
  std::snprintf(words, sizeof words,
                "ended %.2f m and %.1f degrees from its guess, more than three times what guesses are worth", moved_m,
                turned_deg);
  // Control decides which of the two was wrong; without it a person must.
  const Severity severity = node.control.size() >= least_targets ? Severity::warning : Severity::decision;
  findings.push_back(
      {severity, "scan " + scan.name, words, "check its pose in job.json and look at the scans from above"});
}

void place_nodes(RegistrationResult& result, const std::vector<Node>& nodes, const std::vector<Candidate>& candidates,
                 const PoseGraphResult& solved, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  const auto tied = tied_nodes(nodes, candidates, result.pairs);
  const bool datum_needed = std::all_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.control.empty(); });
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    PlacedScan& scan = result.scans[nodes[i].scan];
    bool has_pairs = false;
    for (std::size_t k = 0; k < candidates.size(); ++k)
      has_pairs = has_pairs || (result.pairs[k].used && (candidates[k].source == i || candidates[k].target == i));
    scan.placed = true;
    scan.local_from_scan = solved.local_from_scan[i];
    scan.sigma = sigma_in_axes(solved.covariance[i],
                               tunnel_axes(axis_at(context, nodes, solved.local_from_scan[i].translation())));
    scan.placed_by = how_placed(nodes[i], has_pairs, datum_needed && i == 0);
    if (!tied[i]) {
      result.findings.push_back({Severity::decision, "scan " + scan.name,
                                 "no overlap and no control ties it to the other scans; it stands at its guess",
                                 "check its guess, or survey three targets"});
    }
    name_undetermined(scan, options, result.findings);
    compare_with_guess(scan, nodes[i], options, result.findings);
  }
}

/// Takes over what was used: pairs into the result, and only the control that was used stays with the nodes.
void keep_used(RegistrationResult& result, std::vector<Node>& nodes, const Adjustment& adjustment,
               const PoseGraph& graph) {
  std::size_t k = 0;
  for (PairResult& pair : result.pairs)
    if (pair.used) pair.used = adjustment.pair_used[k++];
  for (Node& node : nodes) node.control.clear();
  for (std::size_t c = 0; c < graph.control.size(); ++c)
    if (adjustment.control_used[c]) nodes[graph.control[c].node].control.push_back(graph.control[c]);
}

void report_control(RegistrationResult& result, const Adjustment& adjustment, const PoseGraph& graph,
                    const std::vector<Node>& nodes, const RegistrationOptions& options) {
  std::vector<double> components;
  for (std::size_t k = 0; k < graph.control.size(); ++k) {
    const GraphControl& control = graph.control[k];
    const std::string& name = nodes[control.node].prepared.name;
    const Eigen::Vector3d residual =
        adjustment.solved.local_from_scan[control.node] * control.in_scan - control.in_local;
    result.control.push_back({name, control.id, residual, adjustment.control_used[k]});
    if (!adjustment.control_used[k]) continue;
    for (const double component : residual) components.push_back(component);
    if (residual.cwiseAbs().maxCoeff() <= wrong_control_sigmas * options.control_sigma_m) continue;
    char words[160];
    std::snprintf(words, sizeof words, "residual of %.1f mm at target %s; over five times its sigma",
                  1000.0 * residual.norm(), control.id.c_str());
    result.findings.push_back({Severity::decision, "scan " + name, words, "check this target and its control point"});
  }
  result.control_rms_m = components.empty() ? 0.0 : root_mean_square(components);
}

void prepare_nodes(std::vector<Node>& nodes, const std::vector<ScanToPlace>& scans, const RegistrationOptions& options,
                   Progress& progress) {
  for (Node& node : nodes) {
    const ScanToPlace& scan = scans[node.scan];
    Progress part = progress.part(1.0 / static_cast<double>(nodes.size()), "preparing scan " + scan.name);
    node.prepared =
        prepare_scan(scan.name, *scan.points, options.spacing_m, scan.scanner_at_origin ? least_range_m : 0.0,
                     scan.scanner_at_origin ? most_range_m : 1e9, part);
  }
}

/// Without control the place of the whole survey is only as good as the guess of its datum scan, and so is every number
/// against a design.
void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  if (std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.control.size() >= least_targets; })) return;
  double span_m = 0.0;
  for (const Node& node : nodes) span_m = std::max(span_m, distance_between_m(node.start, nodes.front().start));
  result.datum_sigma_m = std::hypot(options.guess_sigma_m, 0.5 * span_m * rad_from_deg(options.guess_sigma_deg));
  if (!context.axis_direction || result.datum_sigma_m <= options.undetermined_sigma_m) return;
  char words[240];
  std::snprintf(
      words, sizeof words,
      "there is no control: the survey stands in the site as the guess of its first scan says (sigma %.0f mm), "
      "and so do overbreak and underbreak",
      1000.0 * result.datum_sigma_m);
  result.findings.push_back(
      {Severity::decision, "datum", words,
       "survey three targets, or state in registration.guess_sigma_m and guess_sigma_deg how well the "
       "station is known"});
}

}  // namespace

RegistrationResult register_scans(const std::vector<ScanToPlace>& scans, const RegistrationContext& context,
                                  const RegistrationOptions& options, Progress& progress) {
  check_names(scans, context);
  RegistrationResult result;
  for (const auto& scan : scans) {
    result.scans.emplace_back();
    result.scans.back().name = scan.name;
    result.scans.back().placed_by = "not placed";
  }
  std::vector<Node> nodes = starting_nodes(scans, context);
  Progress preparing = progress.part(0.25, "preparing scans");
  prepare_nodes(nodes, scans, options, preparing);
  const std::vector<Candidate> candidates = candidate_pairs(nodes, options);
  Progress matching = progress.part(0.7, "matching scans");
  result.pairs = register_pairs(nodes, candidates, context, options, matching);
  Progress adjusting = progress.part(0.05, "adjusting all scans");
  const PoseGraph graph = graph_of(nodes, candidates, result.pairs, options);
  const Adjustment adjustment = adjusted(graph, adjusting);
  report_contradictions(result, adjustment, graph, nodes);
  keep_used(result, nodes, adjustment, graph);
  place_nodes(result, nodes, candidates, adjustment.solved, context, options);
  report_control(result, adjustment, graph, nodes, options);
  judge_datum(result, nodes, context, options);
  for (const auto& scan : result.scans) {
    if (!scan.placed)
      result.findings.push_back({Severity::decision, "scan " + scan.name,
                                 "not placed: it has no guess and too few targets",
                                 "give it a pose in job.json or survey three targets"});
  }
  result.accepted = std::none_of(result.findings.begin(), result.findings.end(),
                                 [](const Finding& f) { return f.severity == Severity::decision; });
  return result;
}

}  // namespace adit
