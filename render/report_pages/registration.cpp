#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "render/number_text.h"
#include "render/plan_drawing.h"
#include "render/registration_drawing.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

bool has(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

TableCell sigma_mm(double sigma_m, bool undetermined) {
  return {fixed(1000.0 * sigma_m, 1), undetermined ? colours::red : colours::black, undetermined};
}

TableCell sigma_mdeg(double sigma_rad, bool undetermined) {
  return {fixed(1000.0 * deg_from_rad(sigma_rad), 1), undetermined ? colours::red : colours::black, undetermined};
}

std::string mdeg(double angle_rad) {
  return fixed(1000.0 * deg_from_rad(angle_rad), 1);
}

/// Of a pair by itself, in red where it is known too weakly: what it does not know has no number. `shown` is the sigma
/// in the column's unit, `at_walls_m` what it comes to at the walls.
TableCell known(const PairResult& pair, const char* direction, double shown, double at_walls_m, double limit_m) {
  if (has(pair.undetermined, direction)) return {"\u2013", colours::red, true};
  const bool weak = at_walls_m > limit_m;
  return {fixed(shown, 1), weak ? colours::red : colours::black, weak};
}

/// The pairs that were used, between their stations.
std::vector<PlanTie> ties_of(const RegistrationResult& registration, const Plan& plan) {
  const auto station = [&](const std::string& name) {
    return std::find_if(plan.stations.begin(), plan.stations.end(),
                        [&](const PlanPlace& place) { return place.name == name; });
  };
  std::vector<PlanTie> ties;
  for (const PairResult& pair : registration.pairs) {
    const auto from = station(pair.target), to = station(pair.source);
    if (pair.used && from != plan.stations.end() && to != plan.stations.end())
      ties.push_back({from->position, to->position, pair.undetermined.empty()});
  }
  return ties;
}

void add_plan(PageFlow& flow, const ReportContent& content) {
  const ProjectOrigin& origin = content.results->import.origin;
  Plan plan;
  if (content.results->profile)
    for (const Section& s : content.results->profile->sections)
      plan.axis.push_back({s.chainage_m, s.axis_site.head<2>()});
  for (const PlacedScan& scan : content.results->registration.scans)
    if (scan.placed) plan.stations.push_back({scan.name, origin.to_site(scan.local_from_scan.translation()).head<2>()});
  plan.ties = ties_of(content.results->registration, plan);
  if (content.results->registration.in_site)
    for (const ControlPoint& point : content.control)
      plan.control.push_back({point.id, origin.to_site(point.position).head<2>()});
  if (content.results->registration.in_site)
    for (const ControlPoint& point : content.landmarks)
      plan.landmarks.push_back({point.id, origin.to_site(point.position).head<2>()});
  if (plan.axis.empty() && plan.stations.empty() && plan.control.empty()) return;
  draw_plan(flow.canvas(), flow.take(62.0), plan);
  flow.skip(1.5);
  std::string legend =
      "Triangles: scanner stations. Grey lines: pairs of scans that were used; red, dashed: those that do not know every "
      "direction. ";
  if (!plan.control.empty()) legend += "Green crosses: control points. ";
  if (!plan.landmarks.empty()) legend += "Blue diamonds: coded targets seen in pictures. ";
  if (!plan.axis.empty()) legend += "Dash-dot: the design axis with chainages.";
  flow.paragraph(legend, colours::grey, 2.3);
}

void add_scans(PageFlow& flow, const Results& results) {
  flow.subheading("Where the scans stand");
  Table table{{{"scan", 20, false},
               {"placed by", 24, false},
               {"east", 22, true},
               {"north", 23, true},
               {"elevation", 18, true},
               {"along mm", 13, true},
               {"across mm", 13, true},
               {"up mm", 11, true},
               {"roll mdeg", 12, true},
               {"pitch mdeg", 12, true},
               {"yaw mdeg", 12, true},
               {"not determined", 21, false}},
              {},
              2.1};
  for (const PlacedScan& scan : results.registration.scans) {
    if (!scan.placed) {
      table.rows.push_back({TableCell(scan.name, colours::red), TableCell("not placed", colours::red, true)});
      continue;
    }
    const Eigen::Vector3d site = results.import.origin.to_site(scan.local_from_scan.translation());
    const PoseSigma& s = scan.sigma;
    table.rows.push_back(
        {scan.name, scan.placed_by, fixed(site.x(), 3), fixed(site.y(), 3), fixed(site.z(), 3),
         sigma_mm(s.along_m, has(scan.undetermined, "along")), sigma_mm(s.across_m, has(scan.undetermined, "across")),
         sigma_mm(s.up_m, has(scan.undetermined, "up")), sigma_mdeg(s.roll_rad, has(scan.undetermined, "roll")),
         sigma_mdeg(s.pitch_rad, has(scan.undetermined, "pitch")), sigma_mdeg(s.yaw_rad, has(scan.undetermined, "yaw")),
         TableCell(joined(scan.undetermined), colours::red, true)});
  }
  flow.table(table);
  const std::string frame = results.registration.in_site ? "Site coordinates"
                                                         : "Coordinates, in the frame of scan " +
                                                               results.registration.datum_scan + " and not the site's,";
  flow.paragraph(
      frame +
          " of the scanner in metres; one standard deviation along the tunnel, across it and up, and about "
          "its axes (thousandths of a degree). A direction in red is known too weakly, or not at all and then held at the guess where there is one.",
      colours::grey, 2.3);
}

void add_pairs(PageFlow& flow, const Results& results) {
  std::vector<PairResult> pairs = results.registration.pairs;
  if (pairs.empty()) {
    flow.paragraph("No pairs of scans: one scan, or none that overlap.", colours::grey);
    return;
  }
  flow.subheading("How the pairs fit");
  Table table{{{"scan", 19, false},
               {"on", 19, false},
               {"overlap", 13, true},
               {"median mm", 13, true},
               {"rms mm", 11, true},
               {"within 6 mm", 14, true},
               {"along, across, up", 25, true},
               {"agreeing", 14, true},
               {"seen through", 13, true},
               {"scale \xE2\x80\xB0", 19, true},
               {"iterations", 15, true},
               {"used", 12, false}},
              {},
              2.2};
  for (const PairResult& p : pairs)
    table.rows.push_back(
        {p.source, p.target, percent(p.overlap), p.median_m > 0.0 ? fixed(1000.0 * p.median_m, 1) : "\u2013",
         p.rms_m > 0.0 ? fixed(1000.0 * p.rms_m, 1) : "\u2013", percent(p.within_6mm),
         percent(p.balance.x()) + "  " + percent(p.balance.y()) + "  " + percent(p.balance.z()), percent(p.agreeing),
         percent(p.seen_through, 1),
         p.scale_sigma > 0.0 ? with_sign(1000.0 * (p.scale - 1.0), 2) + " \xC2\xB1 " + fixed(1000.0 * p.scale_sigma, 2)
                             : "",
         std::to_string(p.iterations), p.used ? TableCell("yes") : TableCell("no", colours::red, true)});
  flow.table(table);
  flow.paragraph(
      "Residuals are distances to the surface that both scans make. Along, across, up: where the overlap faces. Agreeing: points that lie on the other scan's "
      "surface, of those where it shows one or its scanner saw through. Seen through: points where the other scanner "
      "measured something behind; what stands there moved, or the pair is wrong. Scale: by how many thousandths the first scan would have to grow, and one sigma of that. Times: pair_timing_s in results.json.",
      colours::grey, 2.3);
  for (const PairResult& p : pairs)
    if (!p.used)
      flow.paragraph("Not used: " + p.source + " on " + p.target + ", which " + p.why_not + ".", colours::grey, 2.3);
  const double height = pair_bars_height(std::min<std::size_t>(pairs.size(), 16));
  draw_pair_bars(flow.canvas(), flow.take(height), std::move(pairs));
  flow.skip(2.0);
}

void add_what_pairs_know(PageFlow& flow, const Results& results, const RegistrationOptions& options) {
  const std::vector<PairResult>& pairs = results.registration.pairs;
  if (pairs.empty()) return;
  flow.subheading("What the pairs know, each alone (one standard deviation)");
  Table table{{{"scan", 26, false},
               {"on", 26, false},
               {"along mm", 15, true},
               {"across mm", 15, true},
               {"up mm", 14, true},
               {"roll mdeg", 15, true},
               {"pitch mdeg", 15, true},
               {"yaw mdeg", 15, true},
               {"not determined", 48, false}},
              {},
              2.2};
  for (const PairResult& p : pairs) {
    const auto move = [&](const char* direction, double sigma_m) {
      return known(p, direction, 1000.0 * sigma_m, sigma_m, options.undetermined_sigma_m);
    };
    const auto turn = [&](const char* direction, double sigma_rad) {
      return known(p, direction, 1000.0 * deg_from_rad(sigma_rad), wall_lever_m * sigma_rad,
                   options.undetermined_sigma_m);
    };
    table.rows.push_back(
        {p.source, p.target, move("along", p.sigma.along_m), move("across", p.sigma.across_m), move("up", p.sigma.up_m),
         turn("roll", p.sigma.roll_rad), turn("pitch", p.sigma.pitch_rad), turn("yaw", p.sigma.yaw_rad),
         TableCell(joined(p.undetermined) + (p.alike_m == 0.0 ? ""
                                                              : " (as well " + fixed(std::abs(p.alike_m), 2) +
                                                                    (p.alike_m > 0.0 ? " m on)" : " m back)")),
                   colours::red, true)});
  }
  flow.table(table);
}

void add_loops(PageFlow& flow, const Results& results) {
  if (results.registration.loops.empty()) return;
  flow.subheading("How loops of pairs close");
  Table table{{{"scans", 109, false},
               {"open before mm", 20, true},
               {"mdeg", 18, true},
               {"open after mm", 20, true},
               {"mdeg", 18, true}},
              {},
              2.2};
  for (const LoopClosure& loop : results.registration.loops)
    table.rows.push_back({joined(loop.scans), fixed(1000.0 * loop.before_m, 1), mdeg(loop.before_rad),
                          fixed(1000.0 * loop.after_m, 1), mdeg(loop.after_rad)});
  flow.table(table);
  flow.paragraph(
      "What the transforms of the pairs leave open once around: each pair alone, and after all were refined together.",
      colours::grey, 2.3);
}

void add_pair_sections(PageFlow& flow, const ReportContent& content) {
  if (content.pair_sections.empty()) return;
  constexpr double height_mm = 58.0, gap_mm = 3.0;
  flow.subheading("Sections through the overlap, across the line between two stations", height_mm);
  const double width_mm = 0.5 * (flow.width_mm() - gap_mm);
  for (std::size_t i = 0; i < content.pair_sections.size(); i += 2) {
    const Rect row = flow.take(height_mm + gap_mm);
    for (std::size_t k = i; k < std::min(i + 2, content.pair_sections.size()); ++k) {
      const double left = row.left + static_cast<double>(k - i) * (width_mm + gap_mm);
      flow.canvas().picture(overlap_picture(content.pair_sections[k], width_mm, height_mm),
                            {left, row.top, width_mm, height_mm});
    }
  }
  const std::size_t all = content.results->registration.pairs.size();
  if (all > content.pair_sections.size())
    flow.paragraph("The " + std::to_string(content.pair_sections.size()) + " pairs with the greatest rms of " +
                       std::to_string(all) + ".",
                   colours::grey, 2.3);
}

/// Where pictures of surveyed targets put the cameras, against where the adjustment puts them.
void add_pictures(PageFlow& flow, const Results& results) {
  const RegistrationResult& registration = results.registration;
  if (registration.pictures.empty()) return;
  flow.subheading("Cameras placed by coded targets, picture minus adjusted");
  Table table{{{"picture", 32, false},
               {"scan", 18, false},
               {"targets", 14, true},
               {"left out", 22, false},
               {"rms px", 14, true},
               {"sigma mm", 18, true},
               {"off mm", 14, true},
               {"mdeg", 13, true},
               {"normalised", 24, true},
               {"used", 16, false}},
              {},
              2.2};
  for (const PictureResult& picture : registration.pictures)
    table.rows.push_back(
        {picture.picture, picture.scan, std::to_string(picture.targets.size()), joined(picture.rejected),
         picture.located ? fixed(picture.rms_px, 2) : "", picture.located ? fixed(1000.0 * picture.sigma_m, 1) : "",
         picture.located ? fixed(1000.0 * picture.residual_m.norm(), 1) : "",
         picture.located ? mdeg(picture.turned_rad.norm()) : "",
         TableCell(picture.located ? fixed(picture.normalised, 1) : "",
                   picture.normalised > wrong_normalised ? colours::red : colours::black),
         TableCell(picture.used ? "yes" : "no", picture.used ? colours::black : colours::red, !picture.used)});
  flow.table(table);
  for (const CameraResult& camera : registration.cameras)
    flow.paragraph("The lever arm of camera " + camera.camera + " was adjusted by " +
                       fixed(1000.0 * camera.moved_m, 1) + " mm and " + mdeg(camera.moved_rad) + " mdeg, " +
                       fixed(camera.normalised, 1) + " times what its sigmas say.",
                   colours::grey, 2.3);
}

void add_control(PageFlow& flow, const Results& results) {
  if (results.registration.control.empty()) {
    const auto& pictures = results.registration.pictures;
    const bool by_pictures =
        std::any_of(pictures.begin(), pictures.end(), [](const PictureResult& picture) { return picture.used; });
    flow.paragraph(
        by_pictures
            ? "No control points: the position of the whole survey is that of the coded targets in its pictures."
            : "No control points: the position of the whole survey is that of its datum scan or guesses.",
        colours::grey);
    return;
  }
  flow.subheading("Targets against control, observed minus control");
  Table table{{{"scan", 27, false},
               {"target", 27, false},
               {"east mm", 20, true},
               {"north mm", 20, true},
               {"up mm", 20, true},
               {"distance mm", 20, true},
               {"redundancy", 18, true},
               {"normalised", 18, true},
               {"used", 10, false}},
              {},
              2.3};
  for (const ControlResidual& r : results.registration.control)
    table.rows.push_back({r.scan, r.id, with_sign(1000.0 * r.residual_m.x(), 1),
                          with_sign(1000.0 * r.residual_m.y(), 1), with_sign(1000.0 * r.residual_m.z(), 1),
                          fixed(1000.0 * r.residual_m.norm(), 1), r.used ? fixed(r.redundancy, 2) : "",
                          TableCell(r.used ? fixed(r.normalised, 1) : "",
                                    r.normalised > wrong_normalised ? colours::red : colours::black),
                          TableCell(r.used ? "yes" : "no", r.used ? colours::black : colours::red, !r.used)});
  flow.table(table);
  flow.paragraph(
      "Redundancy: how much of an error of this target the others would show, 0 nothing, 1 all. Normalised: the "
      "residual in the sigmas it should have, its greatest axis or eight ninths of its length; over 4 is a blunder.",
      colours::grey, 2.3);
  flow.paragraph("Root mean square of the targets used, per axis: " +
                     fixed(1000.0 * results.registration.control_rms_m, 1) + " mm.",
                 colours::black, 2.6, true);
}

/// What makes the registration not accepted, in its own words.
void add_verdict(PageFlow& flow, const Results& results) {
  const RegistrationResult& registration = results.registration;
  if (registration.accepted) {
    const bool all = is_accepted(results);
    flow.paragraph(std::string(all ? "Accepted: every" : "Every") + " scan is placed, every direction is determined." +
                       (all ? "" : " What is still to be decided by a person stands on page 1."),
                   all ? colours::green : colours::black, 2.8, true);
    return;
  }
  flow.paragraph("Not accepted. To be decided by a person:", colours::red, 2.8, true);
  for (const Findings* findings : {&results.targets.findings, &registration.findings})
    for (const Finding& finding : *findings)
      if (finding.severity == Severity::decision)
        flow.paragraph(finding.subject + ": " + finding.words + "; " + finding.mend + ".", colours::red);
}

}  // namespace

void add_registration_pages(PageFlow& flow, const ReportContent& content) {
  const Results& results = *content.results;
  flow.start("Registration");
  add_verdict(flow, results);
  flow.skip(1.0);
  add_plan(flow, content);
  if (results.registration.scans.empty()) {
    flow.paragraph("No scans were placed.", colours::grey);
    return;
  }
  add_scans(flow, results);
  if (results.registration.sigma_factor > 1.0)
    flow.paragraph("Pairs and control contradict one another " + fixed(results.registration.sigma_factor, 1) +
                       " times beyond their own sigmas; those of the scans are multiplied by it.",
                   colours::grey, 2.3);
  add_pairs(flow, results);
  add_what_pairs_know(flow, results, content.job->options.registration);
  add_loops(flow, results);
  add_control(flow, results);
  add_pictures(flow, results);
  add_pair_sections(flow, content);
}

}  // namespace adit::render
