#include "core/registration/registration_findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/foundation/angle.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"
#include "core/registration/scan_pairs.h"

namespace adit {
namespace {

constexpr double huber_sigmas = 4.0;           // as in the adjustment
constexpr double wrong_residual_sigmas = 4.0;  // one in 16,000 by chance

/// What of a target's errors shows in its residual: I - w J C J^T / sigma^2 with the weight w that Huber's loss left
/// it.
Eigen::Vector3d redundancy_of(const Pose& local_from_scan, const Matrix6d& covariance, const Eigen::Vector3d& in_scan,
                              double residual_m, double sigma_m) {
  const double weight = std::min(1.0, huber_sigmas * sigma_m / std::max(residual_m, 1e-12));
  Eigen::Matrix<double, 3, 6> j;
  j << -cross_matrix(local_from_scan.linear() * in_scan), Eigen::Matrix3d::Identity();
  const Eigen::Vector3d taken = weight * (j * covariance * j.transpose()).diagonal() / (sigma_m * sigma_m);
  return (Eigen::Vector3d::Ones() - taken).cwiseMax(0.0).cwiseMin(1.0);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

/// "control point T105", "target T105 of scan S2", ...
std::string name_of(const Suspect& suspect, const PoseGraph& graph, const std::vector<Node>& nodes) {
  const auto scan_of = [&](std::size_t node) { return nodes[node].prepared->name; };
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

}  // namespace

void report_disagreements(RegistrationResult& result, const RegistrationOptions& options) {
  for (const PairResult& pair : result.pairs) {
    if (pair.overlap < options.least_overlap || pair.agreeing >= least_agreeing) continue;
    char words[160];
    std::snprintf(
        words, sizeof words,
        "not used: only %.0f %% of what both show lies on the same surfaces, so the place found is a wrong one",
        100.0 * pair.agreeing);
    result.findings.push_back({Severity::warning, "pair " + pair.source + " - " + pair.target, words,
                               "check the poses of both scans, and whether the place was changed between them"});
  }
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

void report_control(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                    const PoseGraph& graph, const std::vector<Node>& nodes, const RegistrationOptions& options) {
  std::vector<double> components;
  for (std::size_t k = 0; k < graph.control.size(); ++k) {
    const GraphControl& control = graph.control[k];
    const std::string& name = nodes[control.node].prepared->name;
    const Eigen::Vector3d residual = solved.local_from_scan[control.node] * control.in_scan - control.in_local;
    result.control.push_back({name, control.id, residual, adjustment.control_used[k]});
    if (!adjustment.control_used[k]) continue;
    for (const double component : residual) components.push_back(component);
    ControlResidual& reported = result.control.back();
    const Eigen::Vector3d redundancy =
        redundancy_of(solved.local_from_scan[control.node], solved.covariance[control.node], control.in_scan,
                      residual.norm(), options.control_sigma_m);
    constexpr double least_redundancy = 0.01;  // of less, a residual is rounding
    reported.redundancy = redundancy.mean();
    reported.normalised =
        (residual.array().abs() / (options.control_sigma_m * redundancy.array().max(least_redundancy).sqrt()))
            .maxCoeff();
    if (reported.normalised <= wrong_residual_sigmas) continue;
    char words[200];
    std::snprintf(words, sizeof words, "residual of %.1f mm at target %s: %.1f times what its sigma explains",
                  1000.0 * residual.norm(), control.id.c_str(), reported.normalised);
    result.findings.push_back({Severity::decision, "scan " + name, words, "check this target and its control point"});
  }
  result.control_rms_m = components.empty() ? 0.0 : root_mean_square(components);
}

void name_undetermined(PlacedScan& scan, const RegistrationOptions& options, Findings& findings) {
  const std::pair<const char*, double> directions[] = {
      {"along", scan.sigma.along_m}, {"across", scan.sigma.across_m}, {"up", scan.sigma.up_m}};
  for (const auto& [direction, sigma_m] : directions) {
    if (sigma_m <= options.undetermined_sigma_m) continue;
    scan.undetermined.emplace_back(direction);
    char words[160];
    std::snprintf(words, sizeof words, "%s: not determined by the clouds (sigma %.0f mm), held at the guess",
                  std::string_view(direction) == "up" ? "vertically" : (std::string(direction) + " the tunnel").c_str(),
                  1000.0 * sigma_m);
    findings.push_back(
        {Severity::decision, "scan " + scan.name, words, "survey targets for this scan or add scans between"});
  }
  constexpr double lever_m = 5.0;  // walls stand about so far away
  const std::pair<const char*, double> turns[] = {
      {"roll", scan.sigma.roll_rad}, {"pitch", scan.sigma.pitch_rad}, {"yaw", scan.sigma.yaw_rad}};
  for (const auto& [turn, sigma_rad] : turns) {
    if (lever_m * sigma_rad <= options.undetermined_sigma_m) continue;
    scan.undetermined.emplace_back(turn);
    char words[160];
    std::snprintf(words, sizeof words, "%s: not determined by the clouds (sigma %.2f degrees), held at the guess", turn,
                  deg_from_rad(sigma_rad));
    findings.push_back(
        {Severity::decision, "scan " + scan.name, words, "survey targets for this scan or add scans between"});
  }
}

void compare_with_guess(const PlacedScan& scan, const Node& node, const RegistrationOptions& options,
                        Findings& findings) {
  if (node.by != Node::By::guess) return;
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

void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  if (std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.control.size() >= least_targets; })) return;
  double span_m = 0.0;
  for (const Node& node : nodes) span_m = std::max(span_m, distance_between_m(node.start, nodes.front().start));
  result.datum_sigma_m = std::hypot(options.guess_sigma_m, 0.5 * span_m * rad_from_deg(options.guess_sigma_deg));
  if (!context.axis_direction || result.datum_sigma_m <= options.undetermined_sigma_m) return;
  const bool guessed = std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.by == Node::By::guess; });
  if (!guessed) {
    result.findings.push_back(
        {Severity::decision, "datum",
         "there is neither control nor a guess: the survey stands in the frame of its first scan, "
         "not in the site, and nothing can be said of the design",
         "survey three targets, or give one scan a pose in job.json"});
    return;
  }
  const bool some_control = std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return !n.control.empty(); });
  char words[240];
  std::snprintf(
      words, sizeof words,
      "%s: the survey stands in the site as guesses of its scans say (sigma %.0f mm), and so do overbreak and "
      "underbreak",
      some_control ? "no scan has three targets" : "there is no control", 1000.0 * result.datum_sigma_m);
  result.findings.push_back(
      {Severity::decision, "datum", words,
       "survey three targets, or state in registration.guess_sigma_m and guess_sigma_deg how well the "
       "station is known"});
}

}  // namespace adit
