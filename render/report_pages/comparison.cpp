// The job against an earlier one: faces, the round between them, layers, changes; and how even the surface is.

#include "render/face_drawing.h"
#include "render/number_text.h"
#include "render/report_pages.h"

namespace adit::render {
namespace {

std::vector<TableCell> face_row(const std::string& epoch, const FaceMap& face) {
  if (face.cells.empty()) return {epoch, TableCell("not seen", colours::red)};
  const FaceSummary s = summarise(face);
  return {epoch,
          fixed(s.mean_m, 3),
          fixed(s.least_m, 3),
          fixed(s.greatest_m, 3),
          fixed(s.spread_m, 3),
          TableCell(percent(s.share()), s.share() < 0.8 ? colours::red : colours::black),
          fixed(s.hidden_m2, 1)};
}

void add_faces(PageFlow& flow, const ReportContent& content) {
  const CompareResult& result = *content.results->compare;
  const bool two = !result.before.empty();
  flow.subheading("The face, over the design area");
  Table table{{{"epoch", 40, false},
               {"mean chainage", 26, true},
               {"least", 22, true},
               {"greatest", 22, true},
               {"spread m", 20, true},
               {"seen", 16, true},
               {"hidden m\u00b2", 20, true}},
              {},
              2.4};
  if (two) table.rows.push_back(face_row("earlier job", result.face_before));
  table.rows.push_back(face_row("this job", result.face));
  flow.table(table);
  flow.paragraph(
      "Hidden: muck, or rock left at the foot, more than half a metre before the face's middle. Means are "
      "those of the seen part.",
      colours::grey, 2.3);
  const Rect row = flow.take(92.0);
  const double width = (row.width - 4.0) / 2.0;
  const auto lines_at = [&](const FaceMap& face) {
    return content.design != nullptr && !face.cells.empty() ? section_lines(*content.design, summarise(face).mean_m)
                                                            : std::vector<SectionLine>{};
  };
  if (two)
    draw_face(flow.canvas(), {row.left, row.top, width, row.height}, "Earlier face", result.face_before,
              lines_at(result.face_before));
  draw_face(flow.canvas(), {row.left + (two ? width + 4.0 : 0.0), row.top, width, row.height}, "Face of this job",
            result.face, lines_at(result.face));
}

void add_between(PageFlow& flow, const CompareResult& result) {
  if (!result.between.whole) return;
  const FaceVolume& v = result.between;
  flow.subheading("Between the faces");
  Table table{{{"advance m", 20, true},
               {"\u00b12\u03c3 m", 16, true},
               {"excavated m\u00b3", 26, true},
               {"\u00b12\u03c3 m\u00b3", 18, true},
               {"design m\u00b3", 22, true},
               {"guessed m\u00b2", 20, true},
               {"round", 14, true},
               {"drilled m", 18, true},
               {"pull", 14, true},
               {"rock left m", 20, true}},
              {},
              2.4};
  const bool round = result.drilled_m > 0.0;
  table.rows.push_back({fixed(v.advance_m, 3), fixed(2.0 * v.sigma_advance_m, 3), fixed(v.excavated_m3, 1),
                        fixed(2.0 * v.sigma_m3, 1), fixed(v.design_m3, 1), fixed(v.guessed_m2, 1),
                        round ? std::to_string(result.round) : "\u2013", round ? fixed(result.drilled_m, 2) : "\u2013",
                        round ? percent(v.advance_m / result.drilled_m) : "\u2013",
                        round ? fixed(result.left.mean_m, 2) : "\u2013"});
  flow.table(table);
  flow.paragraph(
      "Excavated: what lies within this job's as-built outline and between both faces, with the plan's curvature; design: within the "
      "reference line instead. Guessed: of both faces, taken from the nearest place that was seen." +
          (round ? " Rock left against the drilled depth: " + fixed(result.left.most_m, 2) +
                       " m at the most, the mean above, over 0.3 m on " + percent(result.left.over_03_share) +
                       " of the seen face."
                 : std::string()),
      colours::grey, 2.3);
}

std::string sectors_words(const LayerDesign& design) {
  if (design.sectors.empty()) return "The layer is looked for in every sector, the floor among them. ";
  std::string names;
  for (const std::string& sector : design.sectors) names += (names.empty() ? "" : ", ") + sector;
  return "Sectors with the layer: " + names + ". ";
}

void add_layer(PageFlow& flow, const ReportContent& content) {
  const CompareResult& result = *content.results->compare;
  const LayerResult& layer = result.layer;
  flow.subheading("Surface of this job against \u201c" + result.before + "\u201d");
  const bool said = layer.design.nominal_m > 0.0;
  Table table{{{"measured in both m\u00b2", 30, true},
               {"mean mm", 16, true},
               {"volume m\u00b3", 18, true},
               {"\u00b12\u03c3 m\u00b3", 15, true},
               {"not measured m\u00b2", 26, true},
               {"whole m\u00b3", 17, true},
               {"\u00b12\u03c3 m\u00b3", 15, true},
               {"< minimum", 18, true},
               {"< nominal", 18, true},
               {"\u2265 nominal", 18, true}},
              {},
              2.4};
  const auto share = [&](double value) { return said ? percent(value, 1) : std::string("\u2013"); };
  table.rows.push_back(
      {fixed(layer.measured_m2, 1), fixed(1e3 * layer.mean_m, 1), fixed(layer.volume_m3, 2),
       fixed(2.0 * layer.sigma_volume_m3, 2), fixed(layer.missing_m2, 1), fixed(layer.whole_volume_m3, 2),
       fixed(2.0 * layer.sigma_whole_m3, 2),
       TableCell(share(layer.below_minimum), said && layer.below_minimum > 0.0 ? colours::red : colours::black),
       share(layer.below_nominal), share(layer.from_nominal)});
  flow.table(table);
  const ChangeResult& change = result.change;
  flow.paragraph("Positive: the surface came in. " + sectors_words(layer.design) +
                     "Whole: with the mean where it was not measured, by as much uncertain as square metres differ. " +
                     (said ? "Classes are of " + std::to_string(layer.blocks.size()) +
                                 " blocks of about a square metre: minimum " + fixed(1e3 * layer.design.minimum_m, 0) +
                                 " mm, nominal " + fixed(1e3 * layer.design.nominal_m, 0) + " mm. "
                           : std::string()) +
                     "Changed for certain (95 %, level of detection " + fixed(1e3 * change.level_m, 1) +
                     " mm on the median, with the " + "registration of both): " + fixed(change.inwards_m2, 1) +
                     " m\u00b2 and " + fixed(change.inwards_m3, 2) + " m\u00b3 inwards, " +
                     fixed(change.outwards_m2, 1) + " m\u00b2 and " + fixed(change.outwards_m3, 2) +
                     " m\u00b3 outwards, of " + fixed(change.compared_m2, 1) + " m\u00b2.",
                 colours::grey, 2.3);
  if (content.change == nullptr || content.change->cells.empty()) return;
  const double height = deviation_map_height(*content.change, flow.width_mm());
  draw_deviation_map(flow.canvas(), flow.take(height), *content.change,
                     deviation_scale(seen_deviations(*content.change)), layer_texts(content));
}

void add_undulation(PageFlow& flow, const UndulationResult& result) {
  flow.subheading("Under a straightedge of " + fixed(result.straightedge_m, 2) + " m");
  const bool limited = result.limit_ratio > 0.0;
  Table table{{{"direction", 44, false},
               {"places", 20, true},
               {"deepest mm", 22, true},
               {"at chainage", 22, true},
               {"p m", 16, true},
               {"95 % below mm", 24, true},
               {"depth / gap", 20, true},
               {"over limit", 18, true}},
              {},
              2.4};
  const auto add = [&](const std::string& name, const UndulationDirection& d) {
    if (d.places == 0) {
      table.rows.push_back({name, "0"});
      return;
    }
    table.rows.push_back(
        {name, std::to_string(d.places), fixed(1e3 * d.max_depth_m, 1), fixed(d.chainage_m, 2), with_sign(d.p_m, 2),
         fixed(1e3 * d.depth_95_m, 1),
         TableCell(fixed(d.max_ratio, 3), limited && d.max_ratio > result.limit_ratio ? colours::red : colours::black),
         limited ? percent(d.over_limit, 1) : std::string("\u2013")});
  };
  add("along the axis", result.along);
  add("around the profile", result.around);
  flow.table(table);
  flow.paragraph(
      "The edge touches the innermost points; around the profile it is bent like the design line. " +
          (limited ? "Limit of depth over length of gap: " + fixed(result.limit_ratio, 3) + "." : std::string()),
      colours::grey, 2.3);
}

}  // namespace

MapTexts layer_texts(const ReportContent& content) {
  MapTexts texts{.line = "earlier surface",
                 .marks = {},
                 .rounds = content.job->rounds,
                 .words = {"gone", "come in"},
                 .neutral_within_spread = true};
  const LayerDesign& layer = content.results->compare->layer.design;
  if (layer.nominal_m > 0.0) {
    texts.words.marks.push_back({layer.minimum_m, layer.minimum_m < layer.nominal_m ? "min" : "min = nominal"});
    if (layer.minimum_m < layer.nominal_m) texts.words.marks.push_back({layer.nominal_m, "nom"});
  }
  if (content.design != nullptr) texts.marks = line_marks(*content.design, *content.change);
  return texts;
}

void add_comparison_pages(PageFlow& flow, const ReportContent& content) {
  if (!content.results->compare) return;
  const CompareResult& result = *content.results->compare;
  flow.start(result.before.empty() ? "Face and evenness" : "Before and after");
  if (content.job->face) add_faces(flow, content);
  add_between(flow, result);
  if (!result.before.empty()) add_layer(flow, content);
  if (result.undulation.straightedge_m > 0.0) add_undulation(flow, result.undulation);
}

}  // namespace adit::render
