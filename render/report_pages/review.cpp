// What a person judges: tolerances, reasons of overbreak, clearance.

#include <algorithm>
#include <map>

#include "render/number_text.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

constexpr std::size_t most_intrusions = 60;

/// "0.213 (0.250)": measured and permitted, red beyond it.
TableCell against(double value, double limit, int decimals) {
  if (limit >= ToleranceRow::unlimited) return {fixed(value, decimals), colours::grey};
  return {fixed(value, decimals) + " (" + fixed(limit, decimals) + ")", value > limit ? colours::red : colours::black};
}

TableCell verdict_cell(const ToleranceCheck& check) {
  const ToleranceVerdict verdict = check.verdict();
  if (verdict == ToleranceVerdict::kept) return {words_of(verdict)};
  return {words_of(verdict), colours::red, verdict == ToleranceVerdict::broken};
}

void add_tolerances(PageFlow& flow, const ToleranceResult& tolerances, const std::string& line) {
  flow.subheading("Tolerances: " + tolerances.set + ", against " + line);
  Table table{{{"rock class", 24, false},
               {"sector", 28, false},
               {"verdict", 18, false},
               {"measured", 16, true},
               {"mean over m", 24, true},
               {"max over m", 24, true},
               {"max under m", 24, true},
               {"largest piece m\u00b2", 24, true}},
              {},
              2.3};
  for (const ToleranceCheck& c : tolerances.checks)
    table.rows.push_back({c.rock_class, c.sector, verdict_cell(c),
                          TableCell(percent(c.coverage()),
                                    c.coverage() < ToleranceCheck::least_coverage ? colours::red : colours::black),
                          against(c.mean_overbreak_m, c.limits.mean_overbreak_m, 3),
                          against(c.max_overbreak_m, c.limits.max_overbreak_m, 3),
                          against(c.max_underbreak_m, c.limits.max_underbreak_m, 3),
                          against(c.max_underbreak_area_m2, c.limits.max_underbreak_area_m2, 2)});
  flow.table(table);
  flow.paragraph(
      "In brackets: what the set permits. Of measured places alone. Broken: by more than two sigmas (registration, "
      "distances, noise); \u201cundecided\u201d: by less; \u201cnot shown\u201d: nothing lies beyond a limit, but less "
      "than 80 % was seen. Largest piece: of rock more than 1 cm inside the line. Source of the "
      "set: " +
          tolerances.source +
          ". Verified by: " + (tolerances.verified_by.empty() ? std::string("nobody") : tolerances.verified_by) + ".",
      tolerances.verified_by.empty() ? colours::red : colours::grey, 2.3);
}

void add_reasons(PageFlow& flow, const VolumeResult& volume) {
  flow.subheading("Overbreak by reason, against " + volume.lines.front().line);
  Table table{{{"zone", 12, true},
               {"reason", 24, false},
               {"from m", 18, true},
               {"to m", 18, true},
               {"clock \u00b0", 24, true},
               {"over m\u00b3", 18, true},
               {"max over m", 18, true},
               {"note", 50, false}},
              {},
              2.3};
  double rest_m3 = volume.lines.front().slices.overbreak_m3;
  std::map<std::string, double> sums;
  for (std::size_t i = 0; i < volume.zones.size(); ++i) {
    const auto& [zone, amounts] = volume.zones[i];
    const bool whole = zone.from_deg <= -180.0 && zone.to_deg >= 180.0;
    table.rows.push_back({std::to_string(i + 1), zone.reason, fixed(zone.from_m, 2), fixed(zone.to_m, 2),
                          whole ? std::string("all") : fixed(zone.from_deg, 0) + " to " + fixed(zone.to_deg, 0),
                          fixed(amounts.overbreak_m3, 2), fixed(amounts.max_overbreak_m, 2), zone.note});
    rest_m3 -= amounts.overbreak_m3;
    sums[zone.reason] += amounts.overbreak_m3;
  }
  const auto bold = [](const std::string& text) { return TableCell(text, colours::black, true); };
  for (const auto& [reason, sum] : sums)
    table.rows.push_back({bold("sum"), bold(reason), "", "", "", bold(fixed(sum, 2))});
  table.rows.push_back({"", "unassigned", "", "", "", fixed(rest_m3, 2)});
  flow.table(table);
  flow.paragraph("Reasons are those that a person has written into the job.", colours::grey, 2.3);
}

void add_clearance(PageFlow& flow, const ClearanceResult& clearance) {
  flow.subheading("Clearance line " + clearance.line + " (" + with_sign(clearance.line_offset_m, 2) + " m)");
  if (clearance.points == 0) {
    flow.paragraph("No point of any scan lies inside it.", colours::black, 2.6);
    return;
  }
  Table table{{{"from m", 18, true},
               {"to m", 18, true},
               {"points", 18, true},
               {"deepest inside m", 24, true},
               {"chainage m", 20, true},
               {"offset m", 16, true},
               {"height m", 16, true},
               {"east m", 24, true},
               {"north m", 26, true}},
              {},
              2.3};
  std::vector<const Intrusion*> shown;
  for (const Intrusion& intrusion : clearance.intrusions) shown.push_back(&intrusion);
  std::stable_sort(shown.begin(), shown.end(),
                   [](const Intrusion* a, const Intrusion* b) { return a->deepest.inside_m > b->deepest.inside_m; });
  if (shown.size() > most_intrusions) shown.resize(most_intrusions);
  for (const Intrusion* i : shown)
    table.rows.push_back({fixed(i->from_m, 2), fixed(i->to_m, 2) + (i->cut ? " *" : ""), std::to_string(i->points),
                          TableCell(fixed(i->deepest.inside_m, 3), colours::red), fixed(i->deepest.at.s_m, 2),
                          fixed(i->deepest.at.x_m, 2), fixed(i->deepest.at.z_m, 2), fixed(i->deepest_site.x(), 3),
                          fixed(i->deepest_site.y(), 3)});
  flow.table(table);
  const std::string left = shown.size() < clearance.intrusions.size()
                               ? "The deepest " + std::to_string(shown.size()) + " of " +
                                     std::to_string(clearance.intrusions.size()) + " places. "
                               : std::string();
  const bool cut = std::any_of(shown.begin(), shown.end(), [](const Intrusion* i) { return i->cut; });
  flow.paragraph(left + (cut ? "* reaches an end of the stretch and may go on beyond it. " : "") +
                     "All points count, whatever they belong to: rock, bolts, ducts, machines. clearance.csv lists "
                     "every one of them.",
                 colours::grey, 2.3);
}

}  // namespace

void add_review_pages(PageFlow& flow, const ReportContent& content) {
  const Results& results = *content.results;
  const bool tolerances = results.volume && !results.volume->tolerances.set.empty();
  const bool zones = results.volume && !results.volume->zones.empty();
  const bool clearances = results.profile && !results.profile->clearances.empty();
  if (!tolerances && !zones && !clearances) return;
  flow.start("Review");
  if (tolerances) add_tolerances(flow, results.volume->tolerances, results.volume->lines.front().line);
  if (zones) add_reasons(flow, *results.volume);
  if (clearances)
    for (const ClearanceResult& clearance : results.profile->clearances) add_clearance(flow, clearance);
}

}  // namespace adit::render
