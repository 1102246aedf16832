#include "io/results_json.h"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/foundation/angle.h"
#include "io/comparison_json.h"

namespace adit::io {
namespace {

using json = nlohmann::ordered_json;

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json rows(const Pose& pose) {
  json values = json::array();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) values.push_back(pose.matrix()(r, c));
  return values;
}

json sigma_mm(const PoseSigma& sigma) {
  return {{"along", 1e3 * sigma.along_m}, {"across", 1e3 * sigma.across_m}, {"up", 1e3 * sigma.up_m}};
}

json sigma_mdeg(const PoseSigma& sigma) {
  return {{"roll", 1e3 * deg_from_rad(sigma.roll_rad)},
          {"pitch", 1e3 * deg_from_rad(sigma.pitch_rad)},
          {"yaw", 1e3 * deg_from_rad(sigma.yaw_rad)}};
}

json stretches_json(const std::vector<Stretch>& stretches) {
  json list = json::array();
  for (const Stretch& stretch : stretches) list.push_back({stretch.from_m, stretch.to_m});
  return list;
}

json findings_json(const Findings& findings) {
  json list = json::array();
  for (const Finding& f : findings) {
    const char* severity = f.severity == Severity::note      ? "note"
                           : f.severity == Severity::warning ? "warning"
                                                             : "decision";
    list.push_back({{"severity", severity}, {"subject", f.subject}, {"words", f.words}, {"mend", f.mend}});
  }
  return list;
}

json picture_json(const PictureResult& picture, const ProjectOrigin& origin) {
  Pose site_from_camera = picture.local_from_camera;
  site_from_camera.translation() = origin.to_site(site_from_camera.translation());
  const Eigen::Vector3d &left = picture.residual_m, turned = 1e3 * deg_from_rad(1.0) * picture.turned_rad;
  json one{{"picture", picture.picture}, {"scan", picture.scan}, {"camera", picture.camera}, {"used", picture.used}};
  one["targets"] = picture.targets;
  one["rejected"] = picture.rejected;
  one["not_surveyed"] = picture.unknown;
  one["pose"] = picture.located ? rows(site_from_camera) : json(nullptr);
  if (!picture.located) return one;
  one["rms_px"] = picture.rms_px;
  one["sigma_mm"] = 1e3 * picture.sigma_m;
  one["sigma_mdeg"] = 1e3 * deg_from_rad(picture.sigma_rad);
  one["residual_mm"] = {1e3 * left.x(), 1e3 * left.y(), 1e3 * left.z()};
  one["residual_mdeg"] = {turned.x(), turned.y(), turned.z()};
  one["normalised"] = picture.normalised;
  return one;
}

/// Where a found target lies by the adjusted pose of its scan; null where that was not placed.
json site_of(const FoundTarget& target, const Results& results) {
  const auto& scans = results.registration.scans;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].name != target.scan || !scans[i].placed) continue;
    const Eigen::Vector3d site = site_from_scan(results, i) * target.position;
    return {site.x(), site.y(), site.z()};
  }
  return nullptr;
}

json found_targets_json(const Results& results) {
  json list = json::array();
  for (const FoundTarget& target : results.targets.found) {
    const char* kind = target.kind == TargetKind::sphere     ? "sphere"
                       : target.kind == TargetKind::quarters ? "quarters"
                                                             : "coded";
    list.push_back({{"scan", target.scan},
                    {"kind", kind},
                    {"id", target.id.empty() ? json(nullptr) : json(target.id)},
                    {"position", {target.position.x(), target.position.y(), target.position.z()}},
                    {"site", site_of(target, results)},
                    {"sigma_mm", 1e3 * target.sigma_m},
                    {"size_m", target.size_m},
                    {"pixels", target.pixels}});
  }
  return list;
}

json registration_json(const Results& results) {
  const RegistrationResult& registration = results.registration;
  json out;
  out["accepted"] = registration.accepted;
  out["warnings"] = json::array();
  for (const Finding& f : registration.findings) out["warnings"].push_back(f.subject + ": " + f.words);
  out["scans"] = json::array();
  for (std::size_t i = 0; i < registration.scans.size(); ++i) {
    const PlacedScan& scan = registration.scans[i];
    json one{{"name", scan.name}};
    one["pose"] = scan.placed ? rows(site_from_scan(results, i)) : json(nullptr);
    one["sigma_mm"] = sigma_mm(scan.sigma);
    one["sigma_mdeg"] = sigma_mdeg(scan.sigma);
    one["placed_by"] = scan.placed_by;
    one["undetermined"] = scan.undetermined;
    out["scans"].push_back(one);
  }
  out["pairs"] = json::array();
  for (const PairResult& pair : registration.pairs)
    out["pairs"].push_back(
        {{"source", pair.source},
         {"target", pair.target},
         {"pose", rows(pair.target_from_source)},
         {"overlap", pair.overlap},
         {"rms_m", number(pair.rms_m)},
         {"median_m", number(pair.median_m)},
         {"median_distance_m", number(pair.median_distance_m)},
         {"within_6mm", pair.within_6mm},
         {"balance", {{"along", pair.balance.x()}, {"across", pair.balance.y()}, {"up", pair.balance.z()}}},
         {"agreeing", pair.agreeing},
         {"seen_through", pair.seen_through},
         {"noise_m", pair.noise_m > 0.0 ? json(pair.noise_m) : json(nullptr)},
         {"scale_per_mille", 1e3 * (pair.scale - 1.0)},
         {"scale_sigma_per_mille", pair.scale_sigma > 0.0 ? json(1e3 * pair.scale_sigma) : json(nullptr)},
         {"iterations", pair.iterations},
         {"sigma_mm", sigma_mm(pair.sigma)},
         {"sigma_mdeg", sigma_mdeg(pair.sigma)},
         {"undetermined", pair.undetermined},
         {"alike_m", pair.alike_m == 0.0 ? json(nullptr) : json(pair.alike_m)},
         {"moved_mm", pair.moved.empty() ? json(nullptr) : json(1e3 * pair.moved_m)},
         {"moved_stretches_m", stretches_json(pair.moved)},
         {"lone_witness_m",
          pair.lone_witness.is_empty() ? json(nullptr) : json({pair.lone_witness.from_m, pair.lone_witness.to_m})},
         {"used", pair.used},
         {"why_not", pair.why_not}});
  out["loops"] = json::array();
  for (const LoopClosure& loop : registration.loops)
    out["loops"].push_back({{"scans", loop.scans},
                            {"before_mm", 1e3 * loop.before_m},
                            {"before_mdeg", 1e3 * deg_from_rad(loop.before_rad)},
                            {"after_mm", 1e3 * loop.after_m},
                            {"after_mdeg", 1e3 * deg_from_rad(loop.after_rad)}});
  if (results.targets.looked_in_scans) out["found_targets"] = found_targets_json(results);
  out["control"] = json::array();
  for (const ControlResidual& c : registration.control)
    out["control"].push_back({{"scan", c.scan},
                              {"id", c.id},
                              {"residual_mm", {1e3 * c.residual_m.x(), 1e3 * c.residual_m.y(), 1e3 * c.residual_m.z()}},
                              {"redundancy", c.used ? json(c.redundancy) : json(nullptr)},
                              {"normalised", c.used ? json(c.normalised) : json(nullptr)},
                              {"used", c.used}});
  if (!registration.cameras.empty()) {
    out["pictures"] = json::array();
    for (const PictureResult& picture : registration.pictures)
      out["pictures"].push_back(picture_json(picture, results.import.origin));
    out["cameras"] = json::array();
    for (const CameraResult& camera : registration.cameras)
      out["cameras"].push_back({{"camera", camera.camera},
                                {"scan_from_camera", rows(camera.scan_from_camera)},
                                {"moved_mm", 1e3 * camera.moved_m},
                                {"moved_mdeg", 1e3 * deg_from_rad(camera.moved_rad)},
                                {"normalised", camera.normalised}});
  }
  out["in_site"] = registration.in_site;
  out["datum_scan"] = registration.datum_scan.empty() ? json(nullptr) : json(registration.datum_scan);
  out["datum_sigma_mm"] = registration.in_site ? json(1e3 * registration.datum_sigma_m) : json(nullptr);
  out["sigma_factor"] = registration.sigma_factor;
  out["control_rms_mm"] = 1e3 * registration.control_rms_m;
  return out;
}

json line_json(const SectionAreas& areas) {
  return {{"line", areas.line},
          {"line_offset_m", areas.line_offset_m},
          {"design_area_m2", areas.design_area_m2},
          {"area_m2", areas.area_m2},
          {"overbreak_m2", areas.overbreak_m2},
          {"underbreak_m2", areas.underbreak_m2},
          {"max_overbreak_m", areas.max_overbreak_m},
          {"max_overbreak_p_m", areas.max_overbreak_p_m},
          {"max_underbreak_m", areas.max_underbreak_m},
          {"max_underbreak_p_m", areas.max_underbreak_p_m},
          {"coverage", areas.coverage},
          {"interpolated", areas.interpolated}};
}

/// Members of `more` added to an object.
void add_members(json& object, const json& more) {
  for (const auto& [key, value] : more.items()) object[key] = value;
}

json circle_json(const SectionCircle& circle) {
  return {{"center_offset_m", circle.center.x()},
          {"center_height_m", circle.center.y()},
          {"horizontal_deviation_m", circle.deviation_m.x()},
          {"vertical_deviation_m", circle.deviation_m.y()},
          {"radius_m", circle.radius_m},
          {"design_radius_m", circle.design_radius_m},
          {"ovality_m", number(circle.ovality_m)},
          {"major_clock_deg", number(circle.major_clock_deg)},
          {"rms_m", circle.rms_m},
          {"covered_deg", circle.covered_deg},
          {"sigma_center_m", circle.sigma_center_m},
          {"sigma_radius_m", circle.sigma_radius_m}};
}

json section_json(const Section& section) {
  json one{{"chainage", section.chainage_m}, {"station", section.station_m}};
  one["plane"] = section.plane == SectionPlane::vertical ? "vertical" : "square";
  const Eigen::Vector3d& axis = section.axis_site;
  one["axis"] = {axis.x(), axis.y(), axis.z()};
  one["openings"] = json::array();
  for (const LineOpening& opening : section.openings)
    one["openings"].push_back({{"p_from_m", opening.p_from_m}, {"p_to_m", opening.p_to_m}});
  if (section.circle.there) one["circle"] = circle_json(section.circle);
  if (section.lines.empty()) return one;
  add_members(one, line_json(section.lines.front()));
  one["lines"] = json::array();
  for (const SectionAreas& areas : section.lines) one["lines"].push_back(line_json(areas));
  return one;
}

json amounts_json(const VolumeAmounts& amounts) {
  return {{"design_m3", amounts.design_m3},
          {"excavated_m3", amounts.excavated_m3},
          {"overbreak_m3", amounts.overbreak_m3},
          {"underbreak_m3", amounts.underbreak_m3}};
}

json sector_json(const SectorVolume& sector) {
  const bool any = sector.max_overbreak_m > 0.0;
  return {{"name", sector.name},
          {"surface_m2", sector.surface_m2},
          {"coverage", sector.surface_m2 > 0.0 ? sector.measured_m2 / sector.surface_m2 : 0.0},
          {"overbreak_m3", sector.overbreak_m3},
          {"underbreak_m3", sector.underbreak_m3},
          {"mean_overbreak_m", sector.surface_m2 > 0.0 ? sector.overbreak_m3 / sector.surface_m2 : 0.0},
          {"max_overbreak_m", sector.max_overbreak_m},
          {"max_overbreak_chainage", any ? json(sector.max_overbreak_chainage_m) : json(nullptr)},
          {"max_overbreak_clock_deg", any ? json(sector.max_overbreak_clock_deg) : json(nullptr)}};
}

json review_json(const RoundVolume& round) {
  const RoundReview& r = round.review;
  const SectorVolume worst = worst_sector(round.volume);
  const bool any = worst.max_overbreak_m > 0.0;
  return {{"pull_m", round.pull_m},
          {"pull_efficiency", round.drilled_m > 0.0 ? json(round.pull_m / round.drilled_m) : json(nullptr)},
          {"lookout_collar_m", number(r.lookout_collar_m)},
          {"lookout_toe_m", number(r.lookout_toe_m)},
          {"lookout_per_m", number(r.lookout_per_m)},
          {"lookout_sigma_per_m", number(r.lookout_sigma_per_m)},
          {"contour_ratio", number(r.contour_ratio)},
          {"overbreak_area_sd_m2", number(r.overbreak_area_sd_m2)},
          {"affected_share", number(r.affected_share)},
          {"mean_overbreak_m", number(r.mean_overbreak_m)},
          {"max_overbreak_m", worst.max_overbreak_m},
          {"max_overbreak_chainage", any ? json(worst.max_overbreak_chainage_m) : json(nullptr)},
          {"max_overbreak_clock_deg", any ? json(worst.max_overbreak_clock_deg) : json(nullptr)},
          {"bank_m3", round.volume.slices.excavated_m3},
          {"loose_m3", round.loose_m3 > 0.0 ? json(round.loose_m3) : json(nullptr)}};
}

json volume_json(const Volume& volume) {
  json one{{"line", volume.line},
           {"line_offset_m", volume.line_offset_m},
           {"line_growth_per_m", volume.line_growth_per_m},
           {"from", volume.from_m},
           {"to", volume.to_m}};
  add_members(one, amounts_json(volume.slices));
  one["sigma_m3"] = volume.sigma_excavated_m3;
  one["sigma_overbreak_m3"] = volume.sigma_overbreak_m3;
  one["sigma_underbreak_m3"] = volume.sigma_underbreak_m3;
  one["coverage"] = volume.coverage;
  one["measured_m2"] = volume.measured_m2;
  one["interpolated_m2"] = volume.interpolated_m2;
  one["unseen_m2"] = volume.unseen_m2;
  one["opening_m2"] = volume.opening_m2;
  one["closure_m3"] = volume.closure_m3;
  one["sectors"] = json::array();
  for (const SectorVolume& sector : volume.sectors) one["sectors"].push_back(sector_json(sector));
  one["average_end_area"] = amounts_json(volume.average_end_area);
  one["prismoidal"] = amounts_json(volume.prismoidal);
  if (volume.mesh.there)
    one["mesh"] = {{"excavated_m3", volume.mesh.closed ? json(volume.mesh.excavated_m3) : json(nullptr)},
                   {"filled_m2", volume.mesh.filled_m2}};
  return one;
}

json ring_json(const RingResult& ring, const RingDesign& design) {
  json residuals = json::array();
  for (const RingResidual& residual : ring.residuals)
    residuals.push_back(
        {{"point", residual.point}, {"clock_deg", residual.clock_deg}, {"residual_m", residual.residual_m}});
  return {{"ring", ring.ring},
          {"center", {ring.center.x(), ring.center.y(), ring.center.z()}},
          {"chainage", ring.chainage_m},
          {"station", ring.station_m},
          {"horizontal_deviation_m", ring.horizontal_deviation_m},
          {"vertical_deviation_m", ring.vertical_deviation_m},
          {"radius_m", ring.radius_m},
          {"design_radius_m", design.radius_m > 0.0 ? json(design.radius_m) : json(nullptr)},
          {"tolerance_m", design.tolerance_m > 0.0 ? json(design.tolerance_m) : json(nullptr)},
          {"verdict", design.tolerance_m > 0.0 ? json(words_of(ring.verdict)) : json(nullptr)},
          {"ovality_m", number(ring.ovality_m)},
          {"major_clock_deg", number(ring.major_clock_deg)},
          {"rms_m", ring.rms_m},
          {"sigma_center_m", number(ring.sigma_center_m)},
          {"sigma_radius_m", number(ring.sigma_radius_m)},
          {"tilt_deg", ring.tilt_deg},
          {"points", ring.residuals.size()},
          {"residuals", residuals}};
}

json mesh_json(const MeshSummary& mesh) {
  return {{"points", mesh.points},
          {"triangles", mesh.triangles},
          {"edges", mesh.edges},
          {"boundary_loops", mesh.boundary_loops},
          {"components", mesh.components},
          {"area_m2", mesh.area_m2},
          {"mean_edge_m", mesh.mean_edge_m},
          {"longest_loop_m", mesh.longest_loop_m},
          {"holes_m", mesh.holes_m},
          {"mean_deviation_m", number(mesh.mean_deviation_m)},
          {"sigma_deviation_m", number(mesh.sigma_deviation_m)}};
}

json clearance_json(const ClearanceResult& clearance, const Results& results) {
  json one{{"line", clearance.line}, {"line_offset_m", clearance.line_offset_m}, {"points", clearance.points}};
  one["intrusions"] = json::array();
  for (const Intrusion& intrusion : clearance.intrusions) {
    const ClearancePoint& deepest = intrusion.deepest;
    const Eigen::Vector3d& site = intrusion.deepest_site;
    one["intrusions"].push_back({{"points", intrusion.points},
                                 {"from", intrusion.from_m},
                                 {"to", intrusion.to_m},
                                 {"cut", intrusion.cut},
                                 {"inside_m", deepest.inside_m},
                                 {"chainage", deepest.at.s_m},
                                 {"offset", deepest.at.x_m},
                                 {"height", deepest.at.z_m},
                                 {"site", {site.x(), site.y(), site.z()}},
                                 {"scan", results.import.scans.at(deepest.scan).name}});
  }
  return one;
}

/// Zones with their amounts, and overbreak by reason; what lies in no zone is "unassigned".
void add_zones(json& root, const VolumeResult& volume) {
  if (volume.zones.empty()) return;
  std::map<std::string, double> by_reason;
  double rest_m3 = volume.lines.front().slices.overbreak_m3;
  root["zones"] = json::array();
  for (const auto& [zone, amounts] : volume.zones) {
    json one{{"from", zone.from_m},   {"to", zone.to_m},       {"from_deg", zone.from_deg},
             {"to_deg", zone.to_deg}, {"reason", zone.reason}, {"note", zone.note}};
    json more = sector_json(amounts);
    more.erase("name");
    add_members(one, more);
    root["zones"].push_back(one);
    by_reason[zone.reason] += amounts.overbreak_m3;
    rest_m3 -= amounts.overbreak_m3;
  }
  root["reasons"] = json::object();
  for (const auto& [reason, overbreak_m3] : by_reason) root["reasons"][reason] = {{"overbreak_m3", overbreak_m3}};
  root["reasons"]["unassigned"] = {{"overbreak_m3", rest_m3}};
}

json limit_json(double value) {
  return value >= ToleranceRow::unlimited ? json(nullptr) : json(value);
}

json tolerances_json(const ToleranceResult& tolerances) {
  json one{{"set", tolerances.set}, {"source", tolerances.source}};
  one["verified_by"] = tolerances.verified_by.empty() ? json(nullptr) : json(tolerances.verified_by);
  one["checks"] = json::array();
  for (const ToleranceCheck& c : tolerances.checks)
    one["checks"].push_back(
        {{"rock_class", c.rock_class},
         {"sector", c.sector},
         {"verdict", words_of(c.verdict())},
         {"surface_m2", c.surface_m2},
         {"coverage", c.coverage()},
         {"mean_overbreak_m", c.mean_overbreak_m},
         {"limit_mean_overbreak_m", limit_json(c.limits.mean_overbreak_m)},
         {"max_overbreak_m", c.max_overbreak_m},
         {"limit_max_overbreak_m", limit_json(c.limits.max_overbreak_m)},
         {"max_overbreak_chainage", c.max_overbreak_m > 0.0 ? json(c.max_overbreak_chainage_m) : json(nullptr)},
         {"over_limit_m2", c.over_limit_m2},
         {"max_underbreak_m", c.max_underbreak_m},
         {"limit_max_underbreak_m", limit_json(c.limits.max_underbreak_m)},
         {"max_underbreak_chainage", c.max_underbreak_m > 0.0 ? json(c.max_underbreak_chainage_m) : json(nullptr)},
         {"under_limit_m2", c.under_limit_m2},
         {"max_underbreak_area_m2", c.max_underbreak_area_m2},
         {"sure_mean_overbreak_m", c.sure_mean_overbreak_m},
         {"sure_overbreak_m", c.sure_overbreak_m},
         {"sure_underbreak_m", c.sure_underbreak_m},
         {"sure_underbreak_area_m2", c.sure_underbreak_area_m2},
         {"limit_max_underbreak_area_m2", limit_json(c.limits.max_underbreak_area_m2)}});
  return one;
}

json truth_json(const TruthComparison& truth) {
  return {{"worst_position_error_mm", 1e3 * truth.worst_position_error_m},
          {"worst_rotation_error_deg", deg_from_rad(truth.worst_rotation_error_rad)},
          {"true_volume", amounts_json(truth.true_volume)},
          {"excavated_error", number(truth.excavated_error)},
          {"overbreak_error", number(truth.overbreak_error)},
          {"underbreak_error_m3", number(truth.underbreak_error_m3)},
          {"section_area_rms", number(truth.section_area_rms)}};
}

}  // namespace

std::string results_text(const Results& results) {
  json root;
  root["adit"] = results.version;
  root["inputs"] = json::array();
  for (const InputRecord& input : results.import.inputs)
    root["inputs"].push_back({{"file", input.file}, {"sha256", input.sha256}, {"points", input.points}});
  const Eigen::Vector3d& origin = results.import.origin.position;
  root["origin"] = {origin.x(), origin.y(), origin.z()};
  if (!results.registration.scans.empty()) root["registration"] = registration_json(results);
  if (results.surface) root["mesh"] = mesh_json(results.surface->mesh);
  if (results.profile) {
    root["sections"] = json::array();
    for (const Section& section : results.profile->sections) root["sections"].push_back(section_json(section));
    for (const Section& section : results.profile->square_sections)
      root["square_sections"].push_back(section_json(section));
    for (const ClearanceResult& clearance : results.profile->clearances)
      root["clearance"].push_back(clearance_json(clearance, results));
  }
  if (results.volume && !results.volume->lines.empty()) {
    root["volume"] = volume_json(results.volume->lines.front());
    root["volumes"] = json::array();
    for (const Volume& volume : results.volume->lines) root["volumes"].push_back(volume_json(volume));
    root["rounds"] = json::array();
    for (const RoundVolume& round : results.volume->rounds) {
      json one{{"number", round.number}, {"drilled_m", round.drilled_m > 0.0 ? json(round.drilled_m) : json(nullptr)}};
      one["review"] = review_json(round);
      add_members(one, volume_json(round.volume));
      root["rounds"].push_back(one);
    }
    add_zones(root, *results.volume);
    if (!results.volume->tolerances.set.empty()) root["tolerances"] = tolerances_json(results.volume->tolerances);
  }
  if (results.compare) add_comparison(*results.compare, root);
  if (results.rings) {
    root["rings"] = json::array();
    for (const RingResult& ring : results.rings->rings) root["rings"].push_back(ring_json(ring, results.rings->design));
  }
  if (results.truth) root["truth"] = truth_json(*results.truth);
  root["findings"] = findings_json(all_findings(results));
  root["timing_s"] = json::object();
  for (const StepTime& time : results.timing) root["timing_s"][time.step] = time.seconds;
  for (const PairResult& pair : results.registration.pairs)
    if (pair.seconds > 0.0)
      root["pair_timing_s"].push_back({{"source", pair.source}, {"target", pair.target}, {"seconds", pair.seconds}});
  root["peak_memory_bytes"] = results.peak_memory_bytes;
  return root.dump(1) + "\n";
}

}  // namespace adit::io
