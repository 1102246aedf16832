#include "core/registration/registration_findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/foundation/angle.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"
#include "core/registration/fit_check.h"
#include "core/registration/scan_pairs.h"

namespace adit {
namespace {

constexpr double huber_sigmas = 4.0;  // as in the adjustment

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

constexpr double hardly_agreeing = 0.6;  // wrong places in rock that a guess bears out have up to 0.55

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

/// Simulated pairs stay within 0.01 per mille; real ones (a room, a corridor) come to 2 with sigmas of 1 to 3,
/// for what bends in a scan is no scale: it must be clear.
bool is_other_scale(const PairResult& pair) {
  constexpr double least_off = 3e-4, clear_sigmas = 5.0;
  const double off = std::abs(pair.scale - 1.0);
  return pair.scale_sigma > 0.0 && off > least_off && off > clear_sigmas * pair.scale_sigma;
}

/// Whether used pairs that know every direction lead from one scan to the other.
bool are_tied(const std::vector<PairResult>& pairs, const std::string& one, const std::string& other) {
  std::set<std::string> reached{one};
  for (bool grown = true; grown;) {
    grown = false;
    for (const PairResult& pair : pairs) {
      if (!pair.used || !pair.undetermined.empty()) continue;
      if (reached.count(pair.source) != reached.count(pair.target)) {
        reached.insert({pair.source, pair.target});
        grown = true;
      }
    }
  }
  return reached.count(other) > 0;
}

/// Where a pair fits as well elsewhere along the tunnel, one thing alone tells, or something has moved.
void report_along(const PairResult& pair, const std::string& subject, Findings& findings) {
  const char* const know_along = "survey targets, or state in registration.guess_sigma_m how well the poses are known";
  char words[200];
  if (pair.alike_m != 0.0) {
    std::snprintf(words, sizeof words,
                  "fits as well %.2f m farther %s the tunnel, where its ribs or rings repeat: \"along\" is held",
                  std::abs(pair.alike_m), pair.alike_m > 0.0 ? "along" : "back along");
    findings.push_back({Severity::warning, subject, words, know_along});
  }
  if (!pair.lone_witness.is_empty()) {
    std::snprintf(words, sizeof words,
                  "only what stands %.1f to %.1f m along the tunnel from %s tells \"along\", and it may have moved "
                  "between the scans: \"along\" is held",
                  pair.lone_witness.from_m, pair.lone_witness.to_m, pair.target.c_str());
    findings.push_back({Severity::warning, subject, words, know_along});
  }
  if (!pair.moved.empty()) {
    std::snprintf(words, sizeof words,
                  "what stands %.1f to %.1f m along the tunnel from %s has moved by %.0f mm along it between the "
                  "scans, if the rest has not: it was left out",
                  pair.moved.back().from_m, pair.moved.back().to_m, pair.target.c_str(), 1e3 * pair.moved_m);
    findings.push_back({Severity::warning, subject, words,
                        "look at the scans from above; survey targets where the rest may have moved"});
  }
}

std::string mend_of(Suspect::Kind kind) {
  switch (kind) {
    case Suspect::Kind::pair:
      return "check the poses of both scans, their overlap, and whether each has the file of its station";
    case Suspect::Kind::observation:
      return "check its name, its place in the scan and its control point; it stays left out until these are mended";
    case Suspect::Kind::point:
      return "check its coordinates in the control file, and whether it has moved";
    case Suspect::Kind::scan:
      break;
  }
  return "check whether they are filed under the wrong scan, or some of their names are exchanged";
}

}  // namespace

void report_pairs(RegistrationResult& result, const RegistrationOptions& options) {
  for (const PairResult& pair : result.pairs) {
    const std::string subject = "pair " + pair.source + " - " + pair.target;
    char words[200];
    if (!lies_well(pair) && pair.overlap >= options.least_overlap) {
      // Where other pairs tie both scans, the search alone went wrong.
      const Severity severity = are_tied(result.pairs, pair.source, pair.target) ? Severity::note : Severity::warning;
      result.findings.push_back({severity, subject,
                                 "not used: it " + pair.why_not + ", so the place found is a wrong one",
                                 "check the poses of both scans, and whether the place was changed between them"});
    }
    if (!pair.used) continue;
    if (pair.agreeing < well_agreeing) {
      std::snprintf(words, sizeof words,
                    "only %.0f %% of what both show lies on the same surfaces: a scanner bends what it sees, something "
                    "moved, or the place is a wrong one",
                    100.0 * pair.agreeing);
      result.findings.push_back({pair.agreeing < hardly_agreeing ? Severity::decision : Severity::warning, subject,
                                 words, "look at the picture of their overlap, and check the poses of both"});
    }
    report_along(pair, subject, result.findings);
    if (is_other_scale(pair)) {
      std::snprintf(words, sizeof words, " shows everything %.2f per mille %s (sigma %.2f) than ",
                    1e3 * std::abs(pair.scale - 1.0), pair.scale > 1.0 ? "smaller" : "larger", 1e3 * pair.scale_sigma);
      result.findings.push_back(
          {Severity::decision, subject, pair.source + words + pair.target,
           "check both files' units and the scanners' corrections: volumes err by three times that"});
    }
  }
}

void report_contradictions(RegistrationResult& result, const Adjustment& adjustment, const PoseGraph& graph,
                           const std::vector<Node>& nodes) {
  for (const Contradiction& contradiction : adjustment.contradictions) {
    std::vector<std::string> names;
    for (const Suspect& suspect : contradiction.suspects) names.push_back(name_of(suspect, graph, nodes));
    if (contradiction.left_out) {
      char words[160];
      std::snprintf(words, sizeof words,
                    "contradicts the other observations by %.3f m and was left out of the adjustment",
                    contradiction.off_m);
      result.findings.push_back(
          {Severity::decision, names.front(), words, mend_of(contradiction.suspects.front().kind)});
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
    const Eigen::Vector3d in_sigmas =
        residual.array() / (options.control_sigma_m * redundancy.array().max(least_redundancy).sqrt());
    reported.normalised = std::max(in_sigmas.cwiseAbs().maxCoeff(), 8.0 / 9.0 * in_sigmas.norm());
    if (reported.normalised <= wrong_normalised) continue;
    char words[200];
    std::snprintf(words, sizeof words, "residual of %.1f mm at target %s: %.1f times what its sigma explains",
                  1000.0 * residual.norm(), control.id.c_str(), reported.normalised);
    result.findings.push_back({Severity::decision, "scan " + name, words, "check this target and its control point"});
  }
  result.control_rms_m = components.empty() ? 0.0 : root_mean_square(components);
  // The test of the whole (Baarda 1968): what is wrong a little everywhere fails no test of one target.
  constexpr double most_factor = 1.5;
  if (components.empty() || result.sigma_factor <= most_factor) return;
  char words[160];
  std::snprintf(words, sizeof words, "control and scans contradict one another %.1f times beyond their sigmas",
                result.sigma_factor);
  result.findings.push_back({Severity::decision, "adjustment", words,
                             "check the scale of the control (grid or ground distances), its points and "
                             "registration.control_sigma_m"});
}

void name_undetermined(PlacedScan& scan, bool guessed, const RegistrationOptions& options, Findings& findings) {
  constexpr double as_a_guess = 0.5;  // of its sigma: better is told by something else
  bool held = guessed;
  const PoseSigma& sigma = scan.sigma;
  std::string weak;
  const auto name = [&](const char* direction, double sigma_m, double guess_m, double shown, const char* format) {
    if (sigma_m <= options.undetermined_sigma_m) return;
    held = held && sigma_m >= as_a_guess * guess_m;
    scan.undetermined.emplace_back(direction);
    char words[80];
    std::snprintf(words, sizeof words, format, direction, shown);
    weak += (weak.empty() ? "" : ", ") + std::string(words);
  };
  const double turn_m = wall_lever_m * rad_from_deg(options.guess_sigma_deg);
  name("along", sigma.along_m, options.guess_sigma_m, 1000.0 * sigma.along_m, "%s the tunnel (sigma %.0f mm)");
  name("across", sigma.across_m, options.guess_sigma_m, 1000.0 * sigma.across_m, "%s the tunnel (sigma %.0f mm)");
  name("up", sigma.up_m, options.guess_sigma_m, 1000.0 * sigma.up_m, "%s (sigma %.0f mm)");
  name("roll", wall_lever_m * sigma.roll_rad, turn_m, deg_from_rad(sigma.roll_rad), "%s (sigma %.2f degrees)");
  name("pitch", wall_lever_m * sigma.pitch_rad, turn_m, deg_from_rad(sigma.pitch_rad), "%s (sigma %.2f degrees)");
  name("yaw", wall_lever_m * sigma.yaw_rad, turn_m, deg_from_rad(sigma.yaw_rad), "%s (sigma %.2f degrees)");
  if (weak.empty()) return;
  findings.push_back({Severity::decision, "scan " + scan.name,
                      weak + (held ? ": not determined by the clouds, held at the guess" : ": known too weakly"),
                      "survey targets for this scan or add scans between"});
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

void report_loops(RegistrationResult& result, const RegistrationOptions& options) {
  for (const LoopClosure& loop : result.loops) {
    if (std::max(loop.before_m, wall_lever_m * loop.before_rad) <= options.undetermined_sigma_m) continue;
    char words[200];
    std::snprintf(words, sizeof words,
                  "the pairs around it leave %.0f mm and %.2f degrees open, all refined together %.0f mm and %.2f",
                  1e3 * loop.before_m, deg_from_rad(loop.before_rad), 1e3 * loop.after_m, deg_from_rad(loop.after_rad));
    result.findings.push_back({Severity::warning, "loop " + listed(loop.scans), words,
                               "look at the overlap pictures of these scans: a scanner may bend what it sees, or "
                               "something moved"});
  }
}

void compare_guesses_with_control(RegistrationResult& result, const std::vector<Node>& nodes,
                                  const RegistrationOptions& options) {
  std::vector<Eigen::Vector3d> moves;
  std::size_t controlled = 0;
  for (const Node& node : nodes) {
    controlled += node.control.size();
    if (node.by == Node::By::guess)
      moves.push_back(result.scans[node.scan].local_from_scan.translation() - node.start.translation());
  }
  if (controlled == 0 || moves.size() < 2) return;
  Eigen::Vector3d common = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& move : moves) common += move / static_cast<double>(moves.size());
  const double loose_m = 3.0 * options.guess_sigma_m;
  const auto differs = [&](const Eigen::Vector3d& move) { return (move - common).norm() > loose_m; };
  if (common.norm() <= loose_m || std::any_of(moves.begin(), moves.end(), differs)) return;
  char words[160];
  std::snprintf(words, sizeof words,
                "all %zu scans with a guess stand %.1f m from it, one way: control and guesses are not of one place",
                moves.size(), common.norm());
  result.findings.push_back(
      {Severity::decision, "control", words, "check the coordinates in the control file and the poses in job.json"});
}

void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  if (!result.in_site) {
    const std::string why = context.targets.empty()
                                ? "there is neither control nor a guess"
                                : "there is no guess, and the targets do not tie the scans to the site (three are "
                                  "needed, not on one line) and are not used";
    const bool matters = context.axis_direction || !context.targets.empty();
    result.findings.push_back({matters ? Severity::decision : Severity::note, "datum",
                               why + ": all coordinates are those of scan " + result.datum_scan +
                                   ", not the site's, and nothing is compared with a design",
                               "survey three targets, or give one scan a pose in job.json"});
    return;
  }
  std::set<std::string> points;
  for (const Node& node : nodes)
    for (const GraphControl& control : node.control) points.insert(control.id);
  if (points.size() >= least_targets) return;
  double span_m = 0.0;
  for (const Node& node : nodes) span_m = std::max(span_m, distance_between_m(node.start, nodes.front().start));
  result.datum_sigma_m = std::hypot(options.guess_sigma_m, 0.5 * span_m * rad_from_deg(options.guess_sigma_deg));
  if (result.datum_sigma_m <= options.undetermined_sigma_m) return;
  const std::string by = result.datum_scan.empty()
                             ? "guesses of its scans say, for there are not three targets"
                             : "the guess of scan " + result.datum_scan + " says, for there is no control";
  // Without a design nothing is compared with the site.
  const bool compared = static_cast<bool>(context.axis_direction);
  char words[120];
  std::snprintf(words, sizeof words, " (sigma %.0f mm)%s", 1000.0 * result.datum_sigma_m,
                compared ? ", and so do overbreak and underbreak" : "; the sigmas of the scans are without that");
  result.findings.push_back({compared ? Severity::decision : Severity::note, "datum",
                             "the survey stands in the site as " + by + words,
                             "survey three targets, or state in registration.guess_sigma_m and guess_sigma_deg how "
                             "well the station is known"});
}

}  // namespace adit
