#include "core/registration/registration_findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "core/foundation/angle.h"
#include "core/registration/fit_check.h"
#include "core/registration/scan_pairs.h"

namespace adit {
namespace {

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
  if (suspect.kind == Suspect::Kind::sight)
    return "picture of scan " + scan_of(graph.sights[suspect.sights.front()].node);
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

/// Whether other used pairs that know every direction, and of which so much agrees, lead from one scan of a pair to the
/// other.
bool are_tied_otherwise(const std::vector<PairResult>& pairs, const PairResult& apart, double least_agreeing) {
  const std::string& one = apart.source;
  const std::string& other = apart.target;
  std::set<std::string> reached{one};
  for (bool grown = true; grown;) {
    grown = false;
    for (const PairResult& pair : pairs) {
      if (!pair.used || !pair.undetermined.empty() || pair.agreeing < least_agreeing || &pair == &apart) continue;
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
    case Suspect::Kind::sight:
      return "check whether it was taken during that scan, its targets' coordinates, and how its camera sits";
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
      const Severity severity = are_tied_otherwise(result.pairs, pair, 0.0) ? Severity::note : Severity::warning;
      result.findings.push_back({severity, subject,
                                 "not used: it " + pair.why_not + ", so the place found is not believed",
                                 "check the poses of both scans, and whether the place was changed between them"});
    }
    if (!pair.used) continue;
    if (pair.agreeing < well_agreeing) {
      std::snprintf(words, sizeof words,
                    "only %.0f %% of what both show lies on the same surfaces: a scanner bends what it sees, something "
                    "moved, or the place is a wrong one",
                    100.0 * pair.agreeing);
      const bool alone = !are_tied_otherwise(result.pairs, pair, well_agreeing);
      result.findings.push_back({alone && pair.agreeing < hardly_agreeing ? Severity::decision : Severity::warning,
                                 subject, words, "look at the picture of their overlap, and check the poses of both"});
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
      char turned[60] = "", words[160];
      if (contradiction.turned_rad > 0.0)
        std::snprintf(turned, sizeof turned, " and %.3f degrees", deg_from_rad(contradiction.turned_rad));
      std::snprintf(words, sizeof words,
                    "contradicts the other observations by %.3f m%s and was left out of the adjustment",
                    contradiction.off_m, turned);
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

void compare_with_guess(const PlacedScan& scan, const Node& node, const Pose& moved_from_guesses,
                        const RegistrationOptions& options, Findings& findings) {
  if (node.by != Node::By::guess) return;
  const Pose guess = moved_from_guesses * node.start;
  const double moved_m = distance_between_m(guess, scan.local_from_scan);
  const double turned_deg = deg_from_rad(rotation_between_rad(guess, scan.local_from_scan));
  if (moved_m <= 3.0 * options.guess_sigma_m && turned_deg <= 3.0 * options.guess_sigma_deg) return;
  char words[200];
  std::snprintf(words, sizeof words,
                "ended %.2f m and %.1f degrees from its guess, more than three times what guesses are worth", moved_m,
                turned_deg);
  // Control decides which of the two was wrong; without it a person must.
  const Severity severity = node.is_placed() ? Severity::warning : Severity::decision;
  findings.push_back(
      {severity, "scan " + scan.name, words, "check its pose in job.json and look at the scans from above"});
}

void compare_datum_with_guesses(const PlacedScan& datum, const Pose& moved_from_guesses,
                                const RegistrationOptions& options, Findings& findings) {
  const Pose asked = moved_from_guesses.inverse() * datum.local_from_scan;
  const double moved_m = distance_between_m(asked, datum.local_from_scan);
  const double turned_deg = deg_from_rad(rotation_between_rad(asked, datum.local_from_scan));
  if (moved_m <= 3.0 * options.guess_sigma_m && turned_deg <= 3.0 * options.guess_sigma_deg) return;
  char words[200];
  std::snprintf(words, sizeof words,
                "stands at its guess, but the guesses of the others would put it %.2f m and %.1f degrees from there",
                moved_m, turned_deg);
  findings.push_back(
      {Severity::decision, "scan " + datum.name, words, "check its pose in job.json: the whole survey stands by it"});
}

void report_untied(RegistrationResult& result, const std::vector<Node>& nodes, const std::vector<bool>& tied,
                   const std::vector<std::size_t>& group) {
  const char* const mend =
      "check its guess and registration.pair_distance_m and least_overlap, or survey three targets";
  for (std::size_t first = 0; first < nodes.size(); ++first) {
    if (tied[first] || group[first] != first) continue;
    std::vector<std::string> names;
    bool guessed = false;
    for (std::size_t i = first; i < nodes.size(); ++i) {
      if (group[i] != first) continue;
      names.push_back(result.scans[nodes[i].scan].name);
      guessed = guessed || nodes[i].by == Node::By::guess;
    }
    if (names.size() > 1) {
      result.findings.push_back({Severity::decision, "scans " + listed(names),
                                 "pairs tie them to one another, but no pair and no control ties them to the other "
                                 "scans: together they stand where " +
                                     std::string(guessed ? "their guesses put them" : "a search alone put them"),
                                 mend});
      continue;
    }
    result.findings.push_back({Severity::decision, "scan " + names.front(),
                               std::string("no pair and no control ties it to the other scans") +
                                   (nodes[first].by == Node::By::guess ? "; it stands at its guess" : ""),
                               mend});
  }
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

void judge_datum(RegistrationResult& result, const std::vector<Node>& nodes, const RegistrationContext& context,
                 const RegistrationOptions& options) {
  if (!result.in_site) {
    const std::string why = context.targets.empty()
                                ? "neither a control point nor a guess ties the scans to the site"
                                : "there is no guess, and the targets do not tie the scans to the site (three are "
                                  "needed, not on one line) and are not used";
    const bool matters = context.axis_direction || !context.targets.empty();
    result.findings.push_back({matters ? Severity::decision : Severity::note, "datum",
                               why + ": all coordinates are those of scan " + result.datum_scan +
                                   ", not the site's, and nothing is compared with a design",
                               "survey three targets, or give one scan a pose in job.json"});
    return;
  }
  if (std::any_of(nodes.begin(), nodes.end(), [](const Node& node) { return !node.sights.empty(); })) return;
  std::set<std::string> points;
  for (const Node& node : nodes)
    for (const GraphControl& control : node.control) points.insert(control.id);
  if (points.size() >= least_targets) return;
  double span_m = 0.0;
  for (const Node& node : nodes) span_m = std::max(span_m, distance_between_m(node.start, nodes.front().start));
  result.datum_sigma_m = std::hypot(options.guess_sigma_m, 0.5 * span_m * rad_from_deg(options.guess_sigma_deg));
  if (result.datum_sigma_m <= options.undetermined_sigma_m) return;
  const std::string by = result.datum_scan.empty() ? "guesses of its scans say, for there are not three targets"
                                                   : "the guess of scan " + result.datum_scan +
                                                         " says, for no control point is seen in the scans";
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
