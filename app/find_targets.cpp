#include "app/find_targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "app/placed_tiles.h"
#include "app/site_guess.h"
#include "core/foundation/angle.h"
#include "core/georeference/match_targets.h"

namespace adit::app {
namespace {

ScanTargetOptions options_of(const JobState& state) {
  ScanTargetOptions options;
  options.sphere_radius_m = 0.5 * state.job.scan_targets.sphere_diameter_m;
  options.quarters = state.job.scan_targets.quarters;
  options.coded = state.job.scan_targets.coded;
  return options;
}

/// The control point of a coded target: "7", or "007".
std::string coded_point(const std::vector<ControlPoint>& control, int id) {
  for (const ControlPoint& point : control)
    if (target_id(point.id) == id) return point.id;
  return {};
}

/// A coded target that is not where its control point should be.
void report_contradiction(const std::string& subject, const UnnamedTarget& target,
                          const std::vector<ControlPoint>& control, const Pose& local_from_scan, Findings& findings) {
  const auto point =
      std::find_if(control.begin(), control.end(), [&](const ControlPoint& one) { return one.id == target.id; });
  char words[200];
  std::snprintf(words, sizeof words, "coded target %.40s lies %.3f m from control point %.40s and is not used",
                target.id.c_str(), (local_from_scan * target.in_scan - point->position).norm(), target.id.c_str());
  findings.push_back({Severity::decision, subject, words,
                      "survey the point again: it may have moved, or its id may be wrong in the control file"});
}

/// Control points that no target lies on, with a nameless target beside them. How many.
std::size_t report_moved(const std::string& subject, const std::vector<UnnamedTarget>& targets,
                         const TargetMatch& match, const std::vector<ControlPoint>& control, Findings& findings) {
  constexpr double beside_m = 0.5;
  std::size_t moved = 0;
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (match.control[k] || !targets[k].id.empty()) continue;
    const Eigen::Vector3d at = *match.local_from_scan * targets[k].in_scan;
    for (std::size_t c = 0; c < control.size(); ++c) {
      const double off_m = (at - control[c].position).norm();
      if (off_m > beside_m || std::find(match.control.begin(), match.control.end(), c) != match.control.end()) continue;
      char words[200];
      std::snprintf(words, sizeof words,
                    "a target is found %.3f m from control point %.40s, on which none lies: it is not used", off_m,
                    control[c].id.c_str());
      findings.push_back({Severity::decision, subject, words, "survey the point again: it may have moved"});
      ++moved;
    }
  }
  return moved;
}

/// Coded targets that the control file lacks, in one finding. How many.
std::size_t report_not_surveyed(const std::string& subject, const std::vector<ScanTarget>& seen,
                                const std::vector<ControlPoint>& control, Findings& findings) {
  constexpr std::size_t most_named = 12;
  std::string ids;
  std::size_t count = 0;
  for (const ScanTarget& target : seen) {
    if (target.kind != TargetKind::coded || !coded_point(control, target.code_id).empty()) continue;
    if (count < most_named) ids += (ids.empty() ? "" : ", ") + std::to_string(target.code_id);
    ++count;
  }
  if (count > most_named) ids += " and more";
  if (count > 0)
    findings.push_back({Severity::warning, subject, "coded targets that stand in no row of the control file: " + ids,
                        "survey them, or correct their ids there"});
  return count;
}

/// Those of one scan by control: coded ones that nobody surveyed take no part.
void name_targets(const JobState& state, std::size_t scan, std::vector<ScanTarget> seen,
                  std::vector<FoundTarget>& found, Findings& findings, Progress& progress) {
  std::vector<ControlPoint> control = state.control;
  for (ControlPoint& point : control) point.position = state.results.import.origin.to_local(point.position);
  std::vector<UnnamedTarget> unnamed;
  std::vector<std::size_t> of;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const bool coded = seen[i].kind == TargetKind::coded;
    const std::string id = coded ? coded_point(control, seen[i].code_id) : std::string();
    if (coded && id.empty()) continue;
    unnamed.push_back({seen[i].center, seen[i].sigma_m, id});
    of.push_back(i);
  }
  const RegistrationOptions& registration = state.job.options.registration;
  const auto guess = local_from_scan_guess(state, scan);
  const TargetMatch match = match_targets(
      unnamed, control, guess,
      {registration.control_sigma_m, registration.guess_sigma_m, rad_from_deg(registration.guess_sigma_deg)}, progress);
  std::vector<std::string> id_of(seen.size());
  for (std::size_t k = 0; k < of.size(); ++k) {
    if (match.control[k]) id_of[of[k]] = control[*match.control[k]].id;
    // Too few to be checked by distances: a code speaks for itself, and the adjustment tests it.
    if (!match.local_from_scan && !match.ambiguous) id_of[of[k]] = unnamed[k].id;
  }
  const std::string& name = state.job.scans[scan].name;
  std::size_t nameless = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    nameless += id_of[i].empty() ? 1 : 0;
    found.push_back({name, seen[i].kind, id_of[i], seen[i].center + state.stores[scan]->offset(), seen[i].sigma_m,
                     seen[i].size_m, seen[i].pixels});
  }
  const std::string subject = "scan " + name;
  std::size_t contradicting = 0;
  for (std::size_t k = 0; match.local_from_scan && k < of.size(); ++k) {
    if (unnamed[k].id.empty() || match.control[k]) continue;
    ++contradicting;
    report_contradiction(subject, unnamed[k], control, *match.local_from_scan, findings);
  }
  if (match.local_from_scan) contradicting += report_moved(subject, unnamed, match, control, findings);
  nameless -= std::min(nameless, contradicting);
  nameless -= std::min(nameless, report_not_surveyed(subject, seen, control, findings));
  if (seen.empty()) {
    findings.push_back({Severity::warning, subject, "none of the targets the job asks for is found in it",
                        "scan more densely, or nearer to them"});
  } else if (match.ambiguous) {
    findings.push_back(
        {Severity::decision, subject,
         "its " + std::to_string(seen.size()) + " targets fit the control points in more than one way: none is used",
         "give the scan a pose, or name them in targets.csv"});
  } else if (nameless > 0 && !match.local_from_scan) {
    findings.push_back({Severity::warning, subject,
                        std::to_string(nameless) + " of " + std::to_string(seen.size()) +
                            " targets found in it are not used: no three control points" +
                            (guess ? " about its pose" : "") + " have their distances",
                        "three or more must be seen; check the control file and the scan's pose in job.json"});
  } else if (nameless > 0 && !guess && match.matched == 3) {
    findings.push_back(
        {Severity::decision, subject,
         "only three of its " + std::to_string(seen.size()) +
             " targets lie on control points, and no pose bears it out: three also fit where east and north are "
             "exchanged or heights have the wrong sign",
         "give the scan a pose in job.json, or survey the others; check the control file"});
  } else if (nameless > 0) {
    findings.push_back({Severity::warning, subject,
                        std::to_string(nameless) + " of " + std::to_string(seen.size()) +
                            " targets found in it lie on no control point and are not used",
                        "compare them with the control file: results.json lists them"});
  }
}

/// Kinds that the job asks for and no scan shows.
void report_missing_kinds(const JobScanTargets& wanted, const std::vector<FoundTarget>& found, Findings& findings) {
  const auto none = [&](TargetKind kind) {
    return std::none_of(found.begin(), found.end(), [&](const FoundTarget& target) { return target.kind == kind; });
  };
  const auto report = [&](const std::string& what) {
    findings.push_back({Severity::warning, "targets", what + " is found in any scan",
                        "scan more densely or nearer to them, or do not ask for them in job.json"});
  };
  char sphere[60];
  std::snprintf(sphere, sizeof sphere, "no sphere of %.0f mm", 1e3 * wanted.sphere_diameter_m);
  if (wanted.sphere_diameter_m > 0.0 && none(TargetKind::sphere)) report(sphere);
  if (wanted.quarters && none(TargetKind::quarters)) report("no board of quarters");
  if (wanted.coded && none(TargetKind::coded)) report("no coded target");
}

/// The diameter that the spheres themselves show, over that of the job. A wrong one moves every centre along its line
/// of sight, and all alike.
struct SphereSizes {
  double weights = 0.0, weighted_m = 0.0;

  void add(const std::vector<ScanTarget>& seen) {
    for (const ScanTarget& target : seen) {
      if (target.kind != TargetKind::sphere) continue;
      const double weight = 1.0 / std::max(1e-12, target.size_sigma_m * target.size_sigma_m);
      weights += weight;
      weighted_m += weight * target.size_m;
    }
  }
  void report(double diameter_m, Findings& findings) const {
    constexpr double most_sigmas = 4.0, most_off_m = 0.0015;
    if (weights <= 0.0) return;
    const double mean_m = weighted_m / weights, sigma_m = 1.0 / std::sqrt(weights);
    if (std::abs(mean_m - diameter_m) <= std::max(most_off_m, most_sigmas * sigma_m)) return;
    char words[160];
    std::snprintf(
        words, sizeof words,
        "the spheres measure %.1f mm across (sigma %.1f), the job says %.1f: their centres are off by half of the difference",
        1e3 * mean_m, 1e3 * sigma_m, 1e3 * diameter_m);
    findings.push_back({Severity::decision, "targets", words, "correct sphere_diameter in job.json"});
  }
};

}  // namespace

std::vector<FoundTarget> find_targets(const JobState& state, Findings& findings, Progress& progress) {
  std::vector<FoundTarget> found;
  SphereSizes sizes;
  for (std::size_t i = 0; i < state.stores.size(); ++i) {
    Progress part = progress.part(1.0 / static_cast<double>(state.stores.size()),
                                  "looking for targets in " + state.job.scans[i].name);
    if (!scanner_at_origin(*state.stores[i])) {
      findings.push_back({Severity::warning, "scan " + state.job.scans[i].name,
                          "targets are not looked for: its file does not say where the scanner stood",
                          "export it in the scanner's own frame"});
      continue;
    }
    const JobScanTargets& wanted = state.job.scan_targets;
    if ((wanted.quarters || wanted.coded) && !state.stores[i]->header().has_intensity)
      findings.push_back({Severity::warning, "scan " + state.job.scans[i].name,
                          "boards and coded targets cannot be found in it: its points have no intensity",
                          "export it with intensity"});
    std::vector<ScanTarget> seen = find_scan_targets(*state.stores[i], options_of(state), part);
    sizes.add(seen);
    name_targets(state, i, std::move(seen), found, findings, part);
  }
  sizes.report(state.job.scan_targets.sphere_diameter_m, findings);
  if (!found.empty()) report_missing_kinds(state.job.scan_targets, found, findings);
  return found;
}

}  // namespace adit::app
