#include <algorithm>

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

std::string mdeg(double angle_rad) {
  return fixed(1000.0 * deg_from_rad(angle_rad), 1);
}

void add_plan(PageFlow& flow, const ReportContent& content) {
  const ProjectOrigin& origin = content.results->import.origin;
  Plan plan;
  if (content.results->profile)
    for (const Section& s : content.results->profile->sections)
      plan.axis.push_back({s.chainage_m, s.axis_site.head<2>()});
  for (const PlacedScan& scan : content.results->registration.scans)
    if (scan.placed) plan.stations.push_back({scan.name, origin.to_site(scan.local_from_scan.translation()).head<2>()});
  for (const ControlPoint& point : content.control)
    plan.control.push_back({point.id, origin.to_site(point.position).head<2>()});
  if (plan.axis.empty() && plan.stations.empty() && plan.control.empty()) return;
  draw_plan(flow.canvas(), flow.take(62.0), plan);
  flow.skip(1.5);
  flow.paragraph(
      "Triangles: scanner stations. Green crosses: control points. Dash-dot: the design axis with chainages.",
      colours::grey, 2.3);
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
    table.rows.push_back({scan.name, scan.placed_by, fixed(site.x(), 3), fixed(site.y(), 3), fixed(site.z(), 3),
                          sigma_mm(s.along_m, has(scan.undetermined, "along")),
                          sigma_mm(s.across_m, has(scan.undetermined, "across")),
                          sigma_mm(s.up_m, has(scan.undetermined, "up")), mdeg(s.roll_rad), mdeg(s.pitch_rad),
                          mdeg(s.yaw_rad), TableCell(joined(scan.undetermined), colours::red, true)});
  }
  flow.table(table);
  flow.paragraph(
      "Site coordinates of the scanner in metres; one standard deviation along the tunnel, across it and up, and about "
      "its axes. A direction in red is not known from the clouds or the control; it is held at the guess.",
      colours::grey, 2.3);
}

void add_pairs(PageFlow& flow, const Results& results) {
  std::vector<PairResult> pairs = results.registration.pairs;
  if (pairs.empty()) {
    flow.paragraph("No pairs of scans: one scan, or none that overlap.", colours::grey);
    return;
  }
  flow.subheading("How the pairs fit");
  Table table{{{"scan", 22, false},
               {"on", 22, false},
               {"overlap", 16, true},
               {"median mm", 16, true},
               {"rms mm", 14, true},
               {"within 6 mm", 18, true},
               {"along mm", 15, true},
               {"across mm", 15, true},
               {"up mm", 13, true},
               {"used", 13, false},
               {"not determined", 25, false}},
              {},
              2.2};
  for (const PairResult& p : pairs)
    table.rows.push_back(
        {p.source, p.target, percent(p.overlap), fixed(1000.0 * p.median_m, 1), fixed(1000.0 * p.rms_m, 1),
         percent(p.within_6mm), sigma_mm(p.sigma.along_m, has(p.undetermined, "along")),
         sigma_mm(p.sigma.across_m, has(p.undetermined, "across")), sigma_mm(p.sigma.up_m, has(p.undetermined, "up")),
         p.used ? TableCell("yes") : TableCell("no", colours::red, true),
         TableCell(joined(p.undetermined), colours::red, true)});
  flow.table(table);
  const double height = pair_bars_height(std::min<std::size_t>(pairs.size(), 16));
  draw_pair_bars(flow.canvas(), flow.take(height), std::move(pairs));
  flow.skip(2.0);
}

void add_control(PageFlow& flow, const Results& results) {
  if (results.registration.control.empty()) {
    flow.paragraph("No control points: the position of the whole survey is that of its datum scan or guesses.",
                   colours::grey);
    return;
  }
  flow.subheading("Targets against control, observed minus control");
  Table table{{{"scan", 30, false},
               {"target", 30, false},
               {"east mm", 22, true},
               {"north mm", 22, true},
               {"up mm", 22, true},
               {"distance mm", 24, true},
               {"used", 14, false}},
              {},
              2.3};
  for (const ControlResidual& r : results.registration.control)
    table.rows.push_back({r.scan, r.id, with_sign(1000.0 * r.residual_m.x(), 1),
                          with_sign(1000.0 * r.residual_m.y(), 1), with_sign(1000.0 * r.residual_m.z(), 1),
                          fixed(1000.0 * r.residual_m.norm(), 1),
                          TableCell(r.used ? "yes" : "no", r.used ? colours::black : colours::red, !r.used)});
  flow.table(table);
  flow.paragraph("Root mean square of the targets used, per axis: " +
                     fixed(1000.0 * results.registration.control_rms_m, 1) + " mm.",
                 colours::black, 2.6, true);
}

/// What makes the registration not accepted, in its own words.
void add_verdict(PageFlow& flow, const RegistrationResult& registration) {
  if (registration.accepted) {
    flow.paragraph("Accepted: every scan is placed, every direction is determined.", colours::green, 2.8, true);
    return;
  }
  flow.paragraph("Not accepted. To be decided by a person:", colours::red, 2.8, true);
  for (const Finding& finding : registration.findings)
    if (finding.severity == Severity::decision)
      flow.paragraph(finding.subject + ": " + finding.words + "; " + finding.mend + ".", colours::red);
}

}  // namespace

void add_registration_pages(PageFlow& flow, const ReportContent& content) {
  const Results& results = *content.results;
  flow.start("Registration");
  add_verdict(flow, results.registration);
  flow.skip(1.0);
  add_plan(flow, content);
  if (results.registration.scans.empty()) {
    flow.paragraph("No scans were placed.", colours::grey);
    return;
  }
  add_scans(flow, results);
  add_pairs(flow, results);
  add_control(flow, results);
}

}  // namespace adit::render
