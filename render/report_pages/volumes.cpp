#include <cmath>

#include "render/number_text.h"
#include "render/report_pages.h"
#include "render/volume_chart.h"

namespace adit::render {
namespace {

std::vector<TableCell> method_row(const std::string& line, const std::string& method, const VolumeAmounts& v,
                                  bool bold) {
  const auto number = [&](double value) { return TableCell(fixed(value, 1), colours::black, bold); };
  return {TableCell(line, colours::black, bold),
          TableCell(method, colours::black, bold),
          number(v.design_m3),
          number(v.excavated_m3),
          number(v.overbreak_m3),
          number(v.underbreak_m3),
          number(v.overbreak_m3 - v.underbreak_m3)};
}

std::string line_name(const Volume& v) {
  std::string place = v.line_offset_m != 0.0 ? with_sign(v.line_offset_m, 2) + " m" : std::string();
  if (v.line_growth_per_m != 0.0)
    place += (place.empty() ? "" : ", ") + with_sign(100.0 * v.line_growth_per_m, 1) + " cm a metre of round";
  return v.line + (place.empty() ? "" : " (" + place + ")");
}

void add_methods(PageFlow& flow, const std::vector<Volume>& lines) {
  flow.subheading("Volumes by line and method");
  Table table{{{"line", 34, false},
               {"method", 44, false},
               {"design m\u00b3", 20, true},
               {"excavated m\u00b3", 22, true},
               {"over m\u00b3", 20, true},
               {"under m\u00b3", 20, true},
               {"over minus under m\u00b3", 22, true}},
              {},
              2.4};
  for (const Volume& v : lines) {
    table.rows.push_back(method_row(line_name(v), "thin slices, curved axis", v.slices, true));
    table.rows.push_back(method_row("", "average end area", v.average_end_area, false));
    table.rows.push_back(method_row("", "prismoidal", v.prismoidal, false));
    if (v.mesh.there)
      table.rows.push_back(
          {"", "surface mesh", "",
           v.mesh.closed ? TableCell(fixed(v.mesh.excavated_m3, 1)) : TableCell("open", colours::red)});
  }
  flow.table(table);
  flow.paragraph(
      "The number to use is that of the thin slices. Average end areas and prismoidal volumes stand beside it for "
      "comparison; they are taken from "
      "the sections on over- and underbreak separately and know nothing of the axis' curvature. Excavated volumes differ "
      "from line to line where nothing was seen: there the rock is taken to lie on the line in question.",
      colours::grey, 2.3);
}

void add_quality(PageFlow& flow, const std::vector<Volume>& lines) {
  flow.subheading("How well they are known");
  Table table{{{"line", 28, false},
               {"excavated \u00b12\u03c3 m\u00b3", 21, true},
               {"over \u00b12\u03c3 m\u00b3", 19, true},
               {"under \u00b12\u03c3 m\u00b3", 19, true},
               {"measured", 17, true},
               {"measured m\u00b2", 19, true},
               {"interpolated m\u00b2", 20, true},
               {"not seen m\u00b2", 16, true},
               {"open m\u00b2", 15, true},
               {"closure m\u00b3", 18, true}},
              {},
              2.4};
  for (const Volume& v : lines)
    table.rows.push_back(
        {line_name(v), fixed(2.0 * v.sigma_excavated_m3, 1), fixed(2.0 * v.sigma_overbreak_m3, 1),
         fixed(2.0 * v.sigma_underbreak_m3, 1),
         TableCell(percent(v.coverage, 1), v.coverage < 0.8 ? colours::red : colours::black), fixed(v.measured_m2, 1),
         fixed(v.interpolated_m2, 1), fixed(v.unseen_m2, 1), fixed(v.opening_m2, 1),
         TableCell(fixed(v.closure_m3, 6), std::abs(v.closure_m3) > 0.001 ? colours::red : colours::black)});
  flow.table(table);
  flow.paragraph("Closure: (excavated \u2212 design) \u2212 (over \u2212 under), zero but for rounding.", colours::grey,
                 2.3);
}

std::vector<TableCell> round_row(const RoundVolume& r) {
  const Volume& v = r.volume;
  const double length = v.to_m - v.from_m;
  return {std::to_string(r.number),
          fixed(v.from_m, 2),
          fixed(v.to_m, 2),
          fixed(length, 2),
          r.drilled_m > 0.0 ? fixed(r.drilled_m, 2) : "\u2013",
          r.drilled_m > 0.0 ? percent(length / r.drilled_m) : "\u2013",
          fixed(v.slices.design_m3, 1),
          fixed(v.slices.excavated_m3, 1),
          fixed(v.slices.overbreak_m3, 1),
          fixed(2.0 * v.sigma_overbreak_m3, 1),
          fixed(v.slices.underbreak_m3, 1),
          v.slices.design_m3 > 0.0 ? fixed(100.0 * v.slices.overbreak_m3 / v.slices.design_m3, 1) : "\u2013",
          TableCell(percent(v.coverage), v.coverage < 0.8 ? colours::red : colours::black)};
}

void add_rounds(PageFlow& flow, const VolumeResult& volume) {
  if (volume.rounds.empty()) return;
  flow.subheading("Rounds, against " +
                  (volume.lines.empty() ? std::string("the reference line") : volume.lines.front().line));
  Table table{{{"round", 11, true},
               {"from m", 15, true},
               {"to m", 15, true},
               {"length m", 14, true},
               {"drilled m", 14, true},
               {"pull", 13, true},
               {"design m\u00b3", 15, true},
               {"excav. m\u00b3", 15, true},
               {"over m\u00b3", 14, true},
               {"\u00b12\u03c3 m\u00b3", 13, true},
               {"under m\u00b3", 14, true},
               {"over %", 13, true},
               {"measured", 16, true}},
              {},
              2.2};
  VolumeAmounts sum;
  double length = 0.0;
  for (const RoundVolume& r : volume.rounds) {
    table.rows.push_back(round_row(r));
    length += r.volume.to_m - r.volume.from_m;
    sum.design_m3 += r.volume.slices.design_m3;
    sum.excavated_m3 += r.volume.slices.excavated_m3;
    sum.overbreak_m3 += r.volume.slices.overbreak_m3;
    sum.underbreak_m3 += r.volume.slices.underbreak_m3;
  }
  const auto bold = [](const std::string& text) { return TableCell(text, colours::black, true); };
  table.rows.push_back({bold("sum"), "", "", bold(fixed(length, 2)), "", "", bold(fixed(sum.design_m3, 1)),
                        bold(fixed(sum.excavated_m3, 1)), bold(fixed(sum.overbreak_m3, 1)), "",
                        bold(fixed(sum.underbreak_m3, 1))});
  flow.table(table);
  flow.paragraph(
      "Pull: length of the round over the drilled length. The rounds sum to the volume of the stretch where they cover "
      "it without gaps.",
      colours::grey, 2.3);
}

std::string or_dash(double value, double factor, int decimals) {
  return std::isfinite(value) ? fixed(factor * value, decimals) : std::string("\u2013");
}

void add_sectors(PageFlow& flow, const Volume& v) {
  if (v.sectors.empty()) return;
  flow.subheading("By sector, against " + line_name(v));
  Table table{{{"sector", 30, false},
               {"surface m\u00b2", 20, true},
               {"measured", 17, true},
               {"over m\u00b3", 18, true},
               {"under m\u00b3", 18, true},
               {"mean over m", 18, true},
               {"max over m", 18, true},
               {"at chainage m", 22, true},
               {"clock \u00b0", 14, true}},
              {},
              2.3};
  for (const SectorVolume& s : v.sectors) {
    const double surface_m2 = s.surface_m2 > 0.0 ? s.surface_m2 : 1.0;
    const double coverage = s.measured_m2 / surface_m2;
    const bool any = s.max_overbreak_m > 0.0;
    table.rows.push_back({s.name, fixed(s.surface_m2, 1),
                          TableCell(percent(coverage), coverage < 0.8 ? colours::red : colours::black),
                          fixed(s.overbreak_m3, 2), fixed(s.underbreak_m3, 2), fixed(s.overbreak_m3 / surface_m2, 3),
                          fixed(s.max_overbreak_m, 2), any ? fixed(s.max_overbreak_chainage_m, 2) : "\u2013",
                          any ? fixed(s.max_overbreak_clock_deg, 0) : "\u2013"});
  }
  flow.table(table);
  flow.paragraph(
      "A place belongs to a sector by where the design line's outward normal points there; clock: degrees "
      "clockwise from straight up, looking up-chainage. The sectors sum to the volumes above.",
      colours::grey, 2.3);
}

std::vector<TableCell> review_row(const RoundVolume& r) {
  const RoundReview& review = r.review;
  const SectorVolume worst = worst_sector(r.volume);
  const double sigma = review.lookout_sigma_per_m;
  return {std::to_string(r.number),
          or_dash(review.lookout_collar_m, 1.0, 2),
          or_dash(review.lookout_toe_m, 1.0, 2),
          or_dash(review.lookout_per_m, 100.0, 1) + (std::isfinite(sigma) ? " \u00b1 " + fixed(200.0 * sigma, 1) : ""),
          or_dash(review.mean_overbreak_m, 1.0, 2),
          fixed(worst.max_overbreak_m, 2),
          worst.max_overbreak_m > 0.0 ? worst.name + ", " + fixed(worst.max_overbreak_clock_deg, 0) + "\u00b0" : "",
          or_dash(review.affected_share, 100.0, 0),
          or_dash(review.contour_ratio, 1.0, 3),
          or_dash(review.overbreak_area_sd_m2, 1.0, 2),
          fixed(r.volume.slices.excavated_m3, 1),
          r.loose_m3 > 0.0 ? fixed(r.loose_m3, 1) : "\u2013"};
}

void add_reviews(PageFlow& flow, const ReportContent& content) {
  const VolumeResult& volume = *content.results->volume;
  if (volume.rounds.empty()) return;
  flow.subheading("What the rounds did to their contour, against " + volume.lines.front().line);
  Table table{{{"round", 12, true},
               {"collar m", 14, true},
               {"toe m", 13, true},
               {"look-out cm/m", 22, true},
               {"mean over m", 15, true},
               {"max over m", 14, true},
               {"where", 30, false},
               {"affected %", 15, true},
               {"contour ratio", 15, true},
               {"sd of over m\u00b2", 16, true},
               {"bank m\u00b3", 15, true},
               {"loose m\u00b3", 15, true}},
              {},
              2.1};
  for (const RoundVolume& r : volume.rounds) table.rows.push_back(review_row(r));
  flow.table(table);
  const double swell = content.job->swell;
  flow.paragraph(
      "Walls and roof only. Collar, toe, look-out: regression of the rock over the chainage, with two sigmas "
      "from how blocks of 3 m of the contour differ. Affected: share outside the line; mean over: depth there. "
      "Contour ratio: length of the outline over that of the line. Sd: of the slices' overbreak areas. Bank: "
      "excavated volume" +
          (swell > 0.0 ? "; loose: times the swell of " + fixed(swell, 2) : std::string()) + ".",
      colours::grey, 2.3);
}

}  // namespace

void add_volume_pages(PageFlow& flow, const ReportContent& content) {
  if (!content.results->volume || content.results->volume->lines.empty()) return;
  const VolumeResult& volume = *content.results->volume;
  const Volume& first = volume.lines.front();
  flow.start("Volumes");
  flow.paragraph(
      "Chainage " + fixed(first.from_m, 2) + " to " + fixed(first.to_m, 2) + ", " +
          fixed(first.to_m - first.from_m, 2) + " m." +
          (content.design != nullptr ? " Profiles stand " + std::string(words_of(content.design->plane())) + "."
                                     : std::string()),
      colours::black, 2.8, true);
  add_methods(flow, volume.lines);
  add_quality(flow, volume.lines);
  if (content.results->profile && !content.results->profile->sections.empty()) {
    flow.subheading("Along the chainage, against " + first.line, 84.0);
    draw_volume_chart(flow.canvas(), flow.take(74.0), content.results->profile->sections, content.job->rounds);
  }
  add_sectors(flow, first);
  add_rounds(flow, volume);
  add_reviews(flow, content);
}

}  // namespace adit::render
