#include <algorithm>

#include "render/number_text.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

void add_names(PageFlow& flow, const Job& job, const std::string& date, bool compared) {
  const char* kind = job.scans.empty() ? "Tunnel survey: rings against the axis"
                     : compared        ? "Tunnel survey: overbreak, underbreak and volumes"
                                       : "Tunnel survey: scans in one frame";
  flow.paragraph(kind, colours::grey, 3.2);
  flow.paragraph(job.name.empty() ? "(no name)" : job.name, colours::ink_blue, 6.4, true);
  std::string who;
  const auto add = [&](const char* label, const std::string& words) {
    if (!words.empty()) who += (who.empty() ? "" : "      ") + std::string(label) + words;
  };
  add("Client: ", job.client);
  add("Surveyor: ", job.surveyor);
  add("Date: ", date);
  flow.paragraph(who, colours::black, 2.8);
  flow.skip(2.0);
}

void add_status(PageFlow& flow, const Results& results) {
  const bool accepted = is_accepted(results);
  const Colour colour = accepted ? colours::green : colours::red;
  const Rect band = flow.take(9.0);
  flow.canvas().fill(band, mixed(colour, colours::white, 0.88));
  flow.canvas().fill(Rect{band.left, band.top, 1.6, band.height}, colour);
  const Findings findings = all_findings(results);
  const auto decisions = std::count_if(findings.begin(), findings.end(),
                                       [](const Finding& f) { return f.severity == Severity::decision; });
  std::string words = is_of_rings_alone(results) ? "ACCEPTED: every ring is fitted"
                                                 : "ACCEPTED: every scan is placed and every direction is determined";
  if (!accepted && decisions == 0) words = "NOT ACCEPTED: the registration is not complete";
  if (decisions > 0)
    words = "NOT ACCEPTED: a person must decide (" + std::to_string(decisions) +
            (decisions == 1 ? " finding)" : " findings)");
  flow.canvas().text(
      {band.left + 4.0, band.centre().y()}, words,
      {.size_mm = 3.6, .colour = colour, .bold = true, .down = Down::middle, .shorten_mm = band.width - 6.0});
  flow.skip(3.0);
}

void draw_number(Canvas& canvas, const Rect& box, const std::string& name, const std::string& value,
                 const std::string& below, const Colour& colour) {
  canvas.fill(box, {0.955, 0.965, 0.98});
  canvas.fill(Rect{box.left, box.top, box.width, 0.8}, colour);
  canvas.text({box.left + 2.5, box.top + 2.4}, name, {.size_mm = 2.5, .colour = colours::grey});
  canvas.text({box.left + 2.5, box.top + 6.2}, value, {.size_mm = 5.0, .bold = true, .shorten_mm = box.width - 4.0});
  canvas.text({box.left + 2.5, box.top + 14.0}, below,
              {.size_mm = 2.3, .colour = colours::grey, .shorten_mm = box.width - 4.0});
}

std::string plus_minus(double sigma) {
  return "\u00b1 " + fixed(2.0 * sigma, 1) + " m\u00b3 (2 sigma)";
}

void add_volume_numbers(PageFlow& flow, const Results& results) {
  if (!results.volume || results.volume->lines.empty()) return;
  const Volume& v = results.volume->lines.front();
  flow.paragraph("Reference line: " + v.line +
                     (v.line_offset_m != 0.0 ? " (offset " + with_sign(v.line_offset_m, 2) + " m)" : "") +
                     "     Stretch: chainage " + fixed(v.from_m, 2) + " to " + fixed(v.to_m, 2) + " (" +
                     fixed(v.to_m - v.from_m, 2) + " m)",
                 colours::black, 2.8, true);
  flow.skip(1.0);
  const Rect row = flow.take(19.0);
  const double gap = 3.0, width = (row.width - 3.0 * gap) / 4.0;
  const auto box = [&](int i) { return Rect{row.left + i * (width + gap), row.top, width, row.height}; };
  const std::string unit = " m\u00b3";
  draw_number(flow.canvas(), box(0), "Design volume", fixed(v.slices.design_m3, 1) + unit, "inside the line",
              colours::ink_blue);
  draw_number(flow.canvas(), box(1), "Excavated volume", fixed(v.slices.excavated_m3, 1) + unit,
              plus_minus(v.sigma_excavated_m3), colours::grey);
  draw_number(flow.canvas(), box(2), "Overbreak", fixed(v.slices.overbreak_m3, 1) + unit,
              plus_minus(v.sigma_overbreak_m3), colours::overbreak);
  draw_number(flow.canvas(), box(3), "Underbreak", fixed(v.slices.underbreak_m3, 1) + unit,
              plus_minus(v.sigma_underbreak_m3), colours::underbreak);
  flow.skip(2.0);
  const double surface = v.measured_m2 + v.interpolated_m2 + v.unseen_m2;
  flow.paragraph("Measured " + percent(v.coverage, 1) + " of the surface; interpolated over gaps " +
                     percent(surface > 0.0 ? v.interpolated_m2 / surface : 0.0, 1) + "; not seen " +
                     percent(surface > 0.0 ? v.unseen_m2 / surface : 0.0, 1) +
                     ". Where nothing was seen the rock is taken to lie on the line.",
                 v.coverage < 0.8 ? colours::red : colours::black);
  flow.skip(1.0);
}

void add_findings(PageFlow& flow, const Results& results) {
  Findings shown;
  for (const Severity severity : {Severity::decision, Severity::warning})
    for (const Finding& f : all_findings(results))
      if (f.severity == severity) shown.push_back(f);
  if (shown.empty()) {
    flow.paragraph("No warnings.", colours::green);
    return;
  }
  flow.subheading("What a person must know");
  flow.table(findings_table(shown));
}

void add_truth(PageFlow& flow, const Results& results) {
  if (!results.truth) return;
  const TruthComparison& t = *results.truth;
  flow.subheading("Against the exact truth of this simulated job", 45.0);
  Table table{{{"quantity", 60, false}, {"truth", 30, true}, {"result", 30, true}, {"error", 30, true}}, {}, 2.4};
  const auto percent_error = [](double e) { return with_sign(100.0 * e, 3) + "\u00a0%"; };
  const VolumeAmounts* v =
      results.volume && !results.volume->lines.empty() ? &results.volume->lines.front().slices : nullptr;
  const auto result = [&](double VolumeAmounts::*part) {
    return v != nullptr ? fixed(v->*part, 2) + " m\u00b3" : std::string("\u2013");
  };
  table.rows = {
      {"excavated volume", fixed(t.true_volume.excavated_m3, 2) + " m\u00b3", result(&VolumeAmounts::excavated_m3),
       percent_error(t.excavated_error)},
      {"overbreak volume", fixed(t.true_volume.overbreak_m3, 2) + " m\u00b3", result(&VolumeAmounts::overbreak_m3),
       percent_error(t.overbreak_error)},
      {"underbreak volume", fixed(t.true_volume.underbreak_m3, 2) + " m\u00b3", result(&VolumeAmounts::underbreak_m3),
       with_sign(t.underbreak_error_m3, 3) + " m\u00b3"},
      {"section areas, rms of all sections", "", "", fixed(100.0 * t.section_area_rms, 3) + "\u00a0%"},
      {"worst position of a scan", "", "", fixed(1000.0 * t.worst_position_error_m, 2) + " mm"},
      {"worst direction of a scan", "", "", fixed(1000.0 * t.worst_rotation_error_rad * 180.0 / M_PI, 2) + " mdeg"}};
  flow.table(table);
}

void add_picture(PageFlow& flow, const std::vector<ReportView>& views) {
  const auto find = [&](const char* name) {
    return std::find_if(views.begin(), views.end(), [&](const ReportView& v) { return v.name == name; });
  };
  auto view = find("deviation_above.png");
  if (view == views.end()) view = find("scans_above.png");
  if (view == views.end() || flow.room().height < 45.0) return;
  const double height = std::min(flow.room().height, flow.width_mm() * view->picture.height / view->picture.width);
  const double width = height * view->picture.width / view->picture.height;
  const Rect room = flow.take(height);
  flow.canvas().picture(view->picture, {room.left + (room.width - width) / 2.0, room.top, width, height});
}

}  // namespace

bool is_of_rings_alone(const Results& results) {
  return results.registration.scans.empty() && results.rings.has_value();
}

bool is_accepted(const Results& results) {
  return (results.registration.accepted || is_of_rings_alone(results)) && !needs_a_person(results);
}

Table findings_table(const Findings& findings) {
  Table table{{{"", 17, false}, {"subject", 32, false}, {"what", 78, false}, {"what to do", 58, false}}, {}, 2.4};
  for (const Finding& f : findings) {
    const bool decision = f.severity == Severity::decision;
    const Colour colour = decision ? colours::red : colours::black;
    const char* word = decision ? "DECIDE" : f.severity == Severity::warning ? "warning" : "note";
    table.rows.push_back({TableCell(word, colour, decision), TableCell(f.subject, colour), TableCell(f.words, colour),
                          TableCell(f.mend, colour)});
  }
  return table;
}

void add_title_page(PageFlow& flow, const ReportContent& content, const std::vector<ReportView>& views) {
  flow.start("");
  add_names(flow, *content.job, content.date, content.results->profile.has_value());
  add_status(flow, *content.results);
  add_volume_numbers(flow, *content.results);
  add_findings(flow, *content.results);
  add_truth(flow, *content.results);
  const std::vector<std::string> absent = absent_parts(content);
  if (!absent.empty()) {
    std::string words = "Not in this report: ";
    for (std::size_t i = 0; i < absent.size(); ++i) words += (i > 0 ? "; " : "") + absent[i];
    flow.paragraph(words + ".", colours::grey, 2.4);
  }
  add_picture(flow, views);
}

}  // namespace adit::render
