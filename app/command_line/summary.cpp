#include "app/command_line/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>

#include "core/foundation/angle.h"
#include "core/georeference/camera_rig.h"

namespace adit::app {
namespace {

[[gnu::format(printf, 2, 3)]] void add(std::string& text, const char* format, ...) {
  char line[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

void add_registration(std::string& text, const Results& results) {
  const RegistrationResult& registration = results.registration;
  if (registration.scans.empty()) return;
  add(text, "\nRegistration: %s\n", registration.accepted ? "accepted" : "NOT accepted");
  add(text, "  %-12s %-20s %14s %14s %10s   sigma along/across/up\n", "scan", "placed by", "east", "north",
      "elevation");
  for (std::size_t i = 0; i < registration.scans.size(); ++i) {
    const PlacedScan& scan = registration.scans[i];
    const Eigen::Vector3d p = site_from_scan(results, i).translation();
    add(text, "  %-12s %-20s %14.3f %14.3f %10.3f   %.1f / %.1f / %.1f mm\n", scan.name.c_str(), scan.placed_by.c_str(),
        p.x(), p.y(), p.z(), 1e3 * scan.sigma.along_m, 1e3 * scan.sigma.across_m, 1e3 * scan.sigma.up_m);
  }
  for (const PairResult& pair : registration.pairs) {
    add(text, "  pair %s - %s: overlap %.0f %%", pair.source.c_str(), pair.target.c_str(), 100.0 * pair.overlap);
    const bool meets = pair.median_m > 0.0;  // some surfaces, somewhere
    if (meets && std::isfinite(pair.median_m) && std::isfinite(pair.median_distance_m))
      add(text, ", median residual %.1f mm, median distance %.1f mm", 1e3 * pair.median_m,
          1e3 * pair.median_distance_m);
    text += pair.used ? "\n" : " (not used: " + pair.why_not + ")\n";
  }
  if (!results.targets.found.empty()) {
    const auto count = [&](TargetKind kind) {
      return std::count_if(results.targets.found.begin(), results.targets.found.end(),
                           [&](const FoundTarget& target) { return target.kind == kind; });
    };
    const auto named = std::count_if(results.targets.found.begin(), results.targets.found.end(),
                                     [](const FoundTarget& target) { return !target.id.empty(); });
    add(text,
        "  found in the scans: %td spheres, %td boards of quarters, %td coded targets; %td lie on control points\n",
        count(TargetKind::sphere), count(TargetKind::quarters), count(TargetKind::coded), named);
  }
  const auto used = std::count_if(registration.control.begin(), registration.control.end(),
                                  [](const ControlResidual& residual) { return residual.used; });
  if (!registration.control.empty())
    add(text, "  control: %td of %zu targets used, rms %.1f mm per axis\n", used, registration.control.size(),
        1e3 * registration.control_rms_m);
  for (const PictureResult& picture : registration.pictures) {
    if (!picture.located) continue;
    add(text, "  picture %s: %zu targets, %.1f mm and %.3f degrees from the rest%s\n", picture.picture.c_str(),
        picture.targets.size(), 1e3 * picture.residual_m.norm(), deg_from_rad(picture.turned_rad.norm()),
        picture.used ? "" : " (not used)");
  }
  for (const CameraResult& camera : registration.cameras) {
    const Eigen::Vector3d p = camera.scan_from_camera.translation();
    const YawPitchRoll turn = lever_arm_angles(camera.scan_from_camera);
    add(text,
        "  camera %s sits at %.4f, %.4f, %.4f m, yaw, pitch, roll %.3f, %.3f, %.3f degrees: %.1f mm and %.3f degrees from what the job says\n",
        camera.camera.c_str(), p.x(), p.y(), p.z(), deg_from_rad(turn.yaw_rad), deg_from_rad(turn.pitch_rad),
        deg_from_rad(turn.roll_rad), 1e3 * camera.moved_m, deg_from_rad(camera.moved_rad));
  }
}

void add_volumes(std::string& text, const VolumeResult& result) {
  for (const Volume& volume : result.lines) {
    add(text, "\nVolumes against \"%s\", chainage %.2f to %.2f (coverage %.1f %%, +- is two sigma)\n",
        volume.line.c_str(), volume.from_m, volume.to_m, 100.0 * volume.coverage);
    add(text, "  design %.2f m3   excavated %.2f +- %.2f   overbreak %.2f +- %.2f   underbreak %.2f +- %.2f\n",
        volume.slices.design_m3, volume.slices.excavated_m3, 2.0 * volume.sigma_excavated_m3,
        volume.slices.overbreak_m3, 2.0 * volume.sigma_overbreak_m3, volume.slices.underbreak_m3,
        2.0 * volume.sigma_underbreak_m3);
  }
  const auto other = [&](const Volume& volume) {
    return std::abs(volume.slices.excavated_m3 - result.lines.front().slices.excavated_m3) > 0.005;
  };
  if (std::any_of(result.lines.begin(), result.lines.end(), other))
    text += "  (excavated differs between lines where nothing was seen: there each counts up to itself)\n";
}

void add_review(std::string& text, const Results& results) {
  if (results.profile)
    for (const ClearanceResult& clearance : results.profile->clearances)
      add(text, "\nClearance \"%s\": %llu points in %zu places inside it\n", clearance.line.c_str(),
          static_cast<unsigned long long>(clearance.points), clearance.intrusions.size());
  if (!results.volume) return;
  double rest_m3 = results.volume->lines.empty() ? 0.0 : results.volume->lines.front().slices.overbreak_m3;
  for (std::size_t i = 0; i < results.volume->zones.size(); ++i) {
    const auto& [zone, amounts] = results.volume->zones[i];
    add(text, "%s  zone %zu, %s, chainage %.2f to %.2f: overbreak %.2f m3\n", i == 0 ? "\nZones\n" : "", i + 1,
        zone.reason.c_str(), zone.from_m, zone.to_m, amounts.overbreak_m3);
    rest_m3 -= amounts.overbreak_m3;
  }
  if (!results.volume->zones.empty()) add(text, "  unassigned: overbreak %.2f m3\n", rest_m3);
  const ToleranceResult& tolerances = results.volume->tolerances;
  if (tolerances.set.empty()) return;
  const auto count = [&](ToleranceVerdict verdict) {
    return std::count_if(tolerances.checks.begin(), tolerances.checks.end(),
                         [&](const ToleranceCheck& check) { return check.verdict() == verdict; });
  };
  add(text, "\nTolerances \"%s\": %td of %zu kept, %td broken, %td undecided, %td not shown\n", tolerances.set.c_str(),
      count(ToleranceVerdict::kept), tolerances.checks.size(), count(ToleranceVerdict::broken),
      count(ToleranceVerdict::undecided), count(ToleranceVerdict::not_shown));
}

void add_face(std::string& text, const char* epoch, const FaceMap& face) {
  if (face.cells.empty()) return;
  const FaceSummary summary = summarise(face);
  add(text, "\nFace %s: chainage %.3f on the mean, %.2f to %.2f (%.0f %% seen)\n", epoch, summary.mean_m,
      summary.least_m, summary.greatest_m, 100.0 * summary.share());
}

void add_comparison(std::string& text, const CompareResult& result) {
  add_face(text, "before", result.face_before);
  add_face(text, "of this job", result.face);
  if (result.between.whole)
    add(text, "  between them %.3f +- %.3f m and %.2f +- %.2f m3\n", result.between.advance_m,
        2.0 * result.between.sigma_advance_m, result.between.excavated_m3, 2.0 * result.between.sigma_m3);
  if (!result.before.empty()) {
    const LayerResult& layer = result.layer;
    add(text, "\nAgainst \"%s\": %.1f mm inwards on the mean, %.2f +- %.2f m3, of %.1f m2 measured in both\n",
        result.before.c_str(), 1e3 * layer.mean_m, layer.volume_m3, 2.0 * layer.sigma_volume_m3, layer.measured_m2);
    if (layer.missing_m2 > 0.0)
      add(text, "  with the mean on the %.1f m2 that were not: %.2f +- %.2f m3\n", layer.missing_m2,
          layer.whole_volume_m3, 2.0 * layer.sigma_whole_m3);
    if (layer.design.nominal_m > 0.0)
      add(text,
          "  square metres below the minimum of %.0f mm: %.1f %%, from there to %.0f mm: %.1f %%, more: %.1f %%\n",
          1e3 * layer.design.minimum_m, 100.0 * layer.below_minimum, 1e3 * layer.design.nominal_m,
          100.0 * layer.below_nominal, 100.0 * layer.from_nominal);
    add(text, "  changed for certain (level %.1f mm): %.1f m2 inwards, %.1f m2 outwards\n", 1e3 * result.change.level_m,
        result.change.inwards_m2, result.change.outwards_m2);
  }
  if (result.undulation.straightedge_m > 0.0)
    add(text, "\nUnder a straightedge of %.2f m: %.1f mm along, %.1f mm around at the most\n",
        result.undulation.straightedge_m, 1e3 * result.undulation.along.max_depth_m,
        1e3 * result.undulation.around.max_depth_m);
}

std::string millimetres(double metres) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f mm", 1e3 * metres);
  return text;
}

void add_rings(std::string& text, const RingsResult& result) {
  add(text, "\nRings: %zu (deviations of the centre: right and up positive", result.rings.size());
  if (result.design.radius_m > 0.0) add(text, "; design radius %.4f m", result.design.radius_m);
  if (result.design.tolerance_m > 0.0) {
    const auto kept = std::count_if(result.rings.begin(), result.rings.end(),
                                    [](const RingResult& ring) { return ring.verdict == ToleranceVerdict::kept; });
    add(text, "; %td within %.1f mm", kept, 1e3 * result.design.tolerance_m);
  }
  text += ")\n";
  add(text, "  %-10s %12s %10s %10s %10s %10s %8s %7s\n", "ring", "chainage", "horizontal", "vertical", "radius",
      "ovality", "rms", "points");
  for (const RingResult& ring : result.rings)
    add(text, "  %-10s %12.3f %7.1f mm %7.1f mm %9.4f m %10s %5.1f mm %7zu\n", ring.ring.c_str(), ring.chainage_m,
        1e3 * ring.horizontal_deviation_m, 1e3 * ring.vertical_deviation_m, ring.radius_m,
        std::isfinite(ring.ovality_m) ? millimetres(ring.ovality_m).c_str() : "-", 1e3 * ring.rms_m,
        ring.residuals.size());
}

/// "-" for what could not be compared.
std::string signed_number(double value, const char* unit) {
  if (!std::isfinite(value)) return "-";
  char text[48];
  std::snprintf(text, sizeof text, "%+.3f %s", value, unit);
  return text;
}

void add_truth(std::string& text, const TruthComparison& truth) {
  add(text, "\nAgainst the exact truth of this simulated job\n");
  add(text, "  worst station %.2f mm and %.4f degrees; excavated %s; overbreak %s; underbreak %s\n",
      1e3 * truth.worst_position_error_m, deg_from_rad(truth.worst_rotation_error_rad),
      signed_number(100.0 * truth.excavated_error, "%").c_str(),
      signed_number(100.0 * truth.overbreak_error, "%").c_str(),
      signed_number(truth.underbreak_error_m3, "m3").c_str());
}

}  // namespace

std::string summary_text(const JobState& state) {
  const Results& results = state.results;
  std::string text = state.job.name + "\n";
  for (std::size_t i = 0; i < results.import.scans.size(); ++i)
    add(text, "  %-12s %12llu points\n", results.import.scans[i].name.c_str(),
        static_cast<unsigned long long>(results.import.scans[i].points));
  add_registration(text, results);
  if (results.surface)
    add(text, "\nSurface: %zu triangles, %zu edges, mean edge %.3f m, %zu open loops (%.1f m of holes), area %.1f m2\n",
        results.surface->mesh.triangles, results.surface->mesh.edges, results.surface->mesh.mean_edge_m,
        results.surface->mesh.boundary_loops, results.surface->mesh.holes_m, results.surface->mesh.area_m2);
  if (results.profile) add(text, "\nSections: %zu\n", results.profile->sections.size());
  if (results.volume) add_volumes(text, *results.volume);
  add_review(text, results);
  if (results.compare) add_comparison(text, *results.compare);
  if (results.rings) add_rings(text, *results.rings);
  if (results.truth) add_truth(text, *results.truth);
  for (const Finding& finding : all_findings(results)) {
    const char* sign = finding.severity == Severity::decision  ? "TO DECIDE"
                       : finding.severity == Severity::warning ? "warning"
                                                               : "note";
    text += "\n" + std::string(sign) + ": " + finding.subject + ": " + finding.words +
            (finding.mend.empty() ? "" : "; " + finding.mend);
  }
  text += "\n";
  for (const StepTime& time : results.timing)
    add(text, "%s%s %.1f s", &time == &results.timing.front() ? "\nTime: " : ", ", time.step.c_str(), time.seconds);
  add(text, "; peak memory %.0f MiB\n", static_cast<double>(results.peak_memory_bytes) / 1048576.0);
  if (std::filesystem::exists(state.out / "report.pdf") && !results.timing.empty() &&
      results.timing.back().step == "report")
    text += "Report: " + (state.out / "report.pdf").string() + "\n";
  return text;
}

}  // namespace adit::app
