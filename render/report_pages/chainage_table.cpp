#include <cmath>

#include "render/number_text.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

std::string place(double extreme_m, double p_m) {
  return extreme_m > 0.0 ? fixed(p_m, 1) : "\u2013";
}

constexpr double weak_coverage = 0.8;

std::vector<TableCell> row_of(const Section& section) {
  if (section.lines.empty()) return {fixed(section.chainage_m, 2), fixed(section.station_m, 2)};
  const SectionAreas& a = section.lines.front();
  const bool weak = a.coverage < weak_coverage;
  return {fixed(section.chainage_m, 2),
          fixed(section.station_m, 2),
          fixed(a.design_area_m2, 2),
          fixed(a.area_m2, 2),
          fixed(a.overbreak_m2, 2),
          fixed(a.underbreak_m2, 2),
          fixed(a.max_overbreak_m, 2),
          place(a.max_overbreak_m, a.max_overbreak_p_m),
          fixed(a.max_underbreak_m, 2),
          place(a.max_underbreak_m, a.max_underbreak_p_m),
          TableCell(percent(a.coverage), weak ? colours::red : colours::black, weak),
          percent(a.interpolated)};
}

std::string known(double value, double factor, int decimals) {
  return std::isfinite(value) ? fixed(factor * value, decimals) : std::string("\u2013");
}

/// Both planes at the same chainages, with what the square one has more.
void add_both_planes(PageFlow& flow, const ProfileResult& profile) {
  if (profile.square_sections.empty()) return;
  flow.start("Sections: both planes side by side");
  Table table{{{"chainage m", 20, true},
               {"excavated m\u00b2, vertical", 24, true},
               {"square", 20, true},
               {"difference", 20, true},
               {"over m\u00b2, vertical", 20, true},
               {"square", 18, true},
               {"difference", 20, true},
               {"under m\u00b2, vertical", 20, true},
               {"square", 18, true}},
              {},
              2.3};
  for (std::size_t i = 0; i < profile.sections.size() && i < profile.square_sections.size(); ++i) {
    if (profile.sections[i].lines.empty() || profile.square_sections[i].lines.empty()) continue;
    const SectionAreas& v = profile.sections[i].lines.front();
    const SectionAreas& s = profile.square_sections[i].lines.front();
    table.rows.push_back({fixed(profile.sections[i].chainage_m, 2), fixed(v.area_m2, 2), fixed(s.area_m2, 2),
                          with_sign(s.area_m2 - v.area_m2, 2), fixed(v.overbreak_m2, 2), fixed(s.overbreak_m2, 2),
                          with_sign(s.overbreak_m2 - v.overbreak_m2, 2), fixed(v.underbreak_m2, 2),
                          fixed(s.underbreak_m2, 2)});
  }
  flow.table(table);
  flow.paragraph(
      "The profile stands in the section's plane in both: vertical and square to the axis in plan, or square "
      "to the axis in space. All other pages are of vertical planes.",
      colours::grey, 2.3);
}

/// The best circles of sections whose profile is one.
void add_circles(PageFlow& flow, const std::vector<Section>& sections) {
  Table table{{{"chainage m", 20, true},
               {"station m", 20, true},
               {"centre right mm", 24, true},
               {"up mm", 18, true},
               {"\u00b12\u03c3 mm", 16, true},
               {"radius m", 20, true},
               {"\u00b12\u03c3 mm", 16, true},
               {"design m", 18, true},
               {"ovality mm", 20, true},
               {"largest at \u00b0", 18, true},
               {"rms mm", 16, true},
               {"covered \u00b0", 16, true}},
              {},
              2.3};
  for (const Section& section : sections) {
    const SectionCircle& c = section.circle;
    if (!c.there) continue;
    table.rows.push_back({fixed(section.chainage_m, 2), fixed(section.station_m, 2),
                          with_sign(1e3 * c.deviation_m.x(), 1), with_sign(1e3 * c.deviation_m.y(), 1),
                          fixed(2e3 * c.sigma_center_m, 1), fixed(c.radius_m, 4), fixed(2e3 * c.sigma_radius_m, 1),
                          fixed(c.design_radius_m, 3), known(c.ovality_m, 1e3, 1), known(c.major_clock_deg, 1.0, 0),
                          fixed(1e3 * c.rms_m, 1), fixed(c.covered_deg, 0)});
  }
  if (table.rows.empty()) return;
  flow.start("Sections: best circles");
  flow.table(table);
  flow.paragraph(
      "Least squares through the measured outline, in the section plane. Centre: from where the design has it. "
      "Ovality: largest less smallest diameter of the best ellipse. Sigmas: of the fit with registration and distances; "
      "what the rock hid they do not know.",
      colours::grey, 2.3);
}

}  // namespace

void add_chainage_pages(PageFlow& flow, const ReportContent& content) {
  if (!content.results->profile || content.results->profile->sections.empty()) return;
  const ProfileResult& profile = *content.results->profile;
  const SectionAreas* first =
      profile.sections.front().lines.empty() ? nullptr : &profile.sections.front().lines.front();
  flow.start("Sections: areas and extremes");
  flow.paragraph("Against the line: " + (first != nullptr ? first->line : std::string("(none)")) +
                     ". Over- and underbreak outside and inside of it; p is the arc length along the design line from "
                     "the crown, right "
                     "positive looking up-chainage. Section planes: " +
                     std::string(words_of(profile.sections.front().plane)) +
                     ". Sections measured to less than 80 % are marked red.",
                 colours::black, 2.4);
  Table table{{{"chainage m", 17, true},
               {"station m", 17, true},
               {"design m\u00b2", 15, true},
               {"excavated m\u00b2", 18, true},
               {"over m\u00b2", 14, true},
               {"under m\u00b2", 14, true},
               {"max over m", 14, true},
               {"at p m", 12, true},
               {"max under m", 14, true},
               {"at p m", 12, true},
               {"measured", 16, true},
               {"interpol.", 15, true}},
              {},
              2.3};
  for (const Section& section : profile.sections) table.rows.push_back(row_of(section));
  flow.table(table);
  if (first != nullptr && profile.sections.front().lines.size() > 1)
    flow.paragraph("The areas against the other lines stand in sections.csv.", colours::grey, 2.3);
  flow.paragraph("Points used " + grouped(profile.points_used) +
                     "; left out inside the line (equipment, people, muck) " + grouped(profile.points_inside) +
                     "; left out far outside it " + grouped(profile.points_outside) + ".",
                 colours::grey, 2.3);
  add_both_planes(flow, profile);
  add_circles(flow, profile.sections);
}

}  // namespace adit::render
