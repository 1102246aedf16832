#include "render/section_drawing.h"

#include <algorithm>
#include <cmath>

#include "render/axes.h"
#include "render/map_signs.h"
#include "render/number_text.h"
#include "render/section_outline.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.1;
constexpr double row_mm = 1.42 * text_mm;
constexpr double footer_mm = 4.8 * row_mm;
const Pen excavation_pen{colours::ink_blue, 0.3, {}};
const Pen other_line_pen{colours::ink_blue, 0.2, {1.6, 0.8}};
const Pen measured_pen{colours::black, 0.35, {}};
const Pen interpolated_pen{colours::black, 0.3, {1.0, 0.7}};
const Pen unseen_pen{colours::light_grey, 0.35, {0.3, 0.8}};
const Pen opening_pen{colours::black, 0.55, {0.5, 1.5}};
const Pen axis_pen{colours::grey, 0.15, {2.5, 0.7, 0.4, 0.7}};

PaperRing on_paper(const PlotArea& area, const Polygon& ring) {
  PaperRing points;
  points.reserve(ring.size());
  for (const Eigen::Vector2d& p : ring) points.push_back(area.at(p));
  return thinned(points, 0.01);  // no printer shows more
}

std::vector<PaperRing> on_paper(const PlotArea& area, const std::vector<Polygon>& rings) {
  std::vector<PaperRing> result;
  for (const Polygon& ring : rings) result.push_back(on_paper(area, ring));
  return result;
}

Eigen::AlignedBox2d box_of(const Section& section, const std::vector<SectionLine>& lines) {
  Eigen::AlignedBox2d box;
  for (const OutlinePoint& point : section.outline) box.extend(point.position);
  for (const SectionLine& line : lines)
    for (const Eigen::Vector2d& p : line.ring) box.extend(p);
  if (box.isEmpty()) box.extend(Eigen::Vector2d(-5.0, -5.0)).extend(Eigen::Vector2d(5.0, 5.0));
  box.extend(Eigen::Vector2d::Zero());
  // Room for the labels of the extremes.
  const Eigen::Vector2d margin(0.07 * box.sizes().x() + 0.3, 0.03 * box.sizes().y() + 0.2);
  return {box.min() - margin, box.max() + margin};
}

void draw_axis_cross(Canvas& canvas, const PlotArea& area) {
  canvas.line({area.rect.left, area.paper_y(0.0)}, {area.rect.right(), area.paper_y(0.0)}, axis_pen);
  canvas.line({area.paper_x(0.0), area.rect.top}, {area.paper_x(0.0), area.rect.bottom()}, axis_pen);
  const PaperPoint zero = area.at(0.0, 0.0);
  const Pen cross{colours::black, 0.35, {}};
  canvas.line(zero - PaperPoint(1.6, 0.0), zero + PaperPoint(1.6, 0.0), cross);
  canvas.line(zero - PaperPoint(0.0, 1.6), zero + PaperPoint(0.0, 1.6), cross);
}

const Pen& pen_of(CellKind kind) {
  if (kind == CellKind::opening) return opening_pen;
  return kind == CellKind::measured ? measured_pen : kind == CellKind::interpolated ? interpolated_pen : unseen_pen;
}

// The gaps stay open: a dotted trace along the line says that nobody looked there, or that there is none.
void draw_outline(Canvas& canvas, const PlotArea& area, const std::vector<OutlineRun>& runs) {
  for (const OutlineRun& run : runs) {
    if (has_rock(run.kind)) {
      canvas.polyline(on_paper(area, run.points), pen_of(run.kind));
    } else if (run.points.size() > 3) {
      canvas.polyline(on_paper(area, Polygon(run.points.begin() + 1, run.points.end() - 1)), pen_of(run.kind));
    }
  }
}

// A mark at the outline, a leader and the value with its sign, kept inside the frame.
void draw_extreme(Canvas& canvas, const PlotArea& area, const Section& section, double p_m, double value_m, bool over) {
  const OutlinePoint* place = outline_at(section.outline, p_m);
  if (place == nullptr || value_m < 0.005) return;
  const PaperPoint at = area.at(place->position);
  const PaperPoint outwards(place->normal.x(), -place->normal.y());
  const PaperPoint away = outwards * (over ? 1.0 : -1.0);
  const Colour colour = over ? colours::red : colours::underbreak;
  const std::string words = with_sign(over ? value_m : -value_m, 2) + " m";
  const TextStyle style{.size_mm = text_mm + 0.1, .colour = colour, .bold = true, .down = Down::middle, .halo_mm = 0.3};
  const Eigen::Vector2d size = canvas.text_size(words, style);
  const Rect inner = area.rect.inset(0.6);
  PaperPoint end = at + away * 3.5;
  double left = away.x() >= 0.0 ? end.x() + 0.4 : end.x() - 0.4 - size.x();
  left = std::clamp(left, inner.left, inner.right() - size.x());
  end.y() = std::clamp(end.y(), inner.top + size.y() / 2.0, inner.bottom() - size.y() / 2.0);
  // Pushed back over its own mark: then beside it.
  if (left - 0.8 < at.x() && at.x() < left + size.x() + 0.8 && std::abs(end.y() - at.y()) < 0.8 * size.y())
    left = at.x() + 1.5 + size.x() < inner.right() ? at.x() + 1.5 : at.x() - 1.5 - size.x();
  end.x() = std::clamp(end.x(), left, left + size.x());
  canvas.disc(at, 0.6, colour);
  canvas.line(at, end, {colour, 0.2, {}});
  canvas.text({left, end.y()}, words, style);
}

struct KeyLine {
  std::string name;
  Pen pen;
};

std::vector<KeyLine> key_of(const std::vector<OutlineRun>& runs, const std::vector<SectionLine>& lines) {
  std::vector<KeyLine> key;
  for (std::size_t i = 0; i < lines.size(); ++i)
    key.push_back({lines[i].name + (lines[i].offset_m != 0.0 ? " " + with_sign(lines[i].offset_m, 2) + " m" : ""),
                   i == 0 ? excavation_pen : other_line_pen});
  const auto has = [&](CellKind kind) {
    return std::any_of(runs.begin(), runs.end(), [&](const OutlineRun& run) { return run.kind == kind; });
  };
  if (has(CellKind::measured)) key.push_back({"measured", measured_pen});
  if (has(CellKind::interpolated)) key.push_back({"interpolated", interpolated_pen});
  if (has(CellKind::unseen)) key.push_back({"not seen", {colours::grey, unseen_pen.width_mm, unseen_pen.dashes_mm}});
  if (has(CellKind::opening)) key.push_back({"open", opening_pen});
  return key;
}

void draw_key(Canvas& canvas, const PaperPoint& at, double room_mm, const std::vector<KeyLine>& key) {
  const double sample = 6.0;
  double y = at.y() + 0.6 * text_mm;
  for (const KeyLine& line : key) {
    canvas.line({at.x(), y}, {at.x() + sample, y}, line.pen);
    canvas.text({at.x() + sample + 1.0, y}, line.name,
                {.size_mm = text_mm, .down = Down::middle, .shorten_mm = room_mm - sample - 1.0});
    y += row_mm;
  }
}

std::string break_words(const char* what, double area_m2, double most_m, double p_m) {
  const std::string words = what + fixed(area_m2, 2) + " m\u00b2   max " + fixed(most_m, 2) + " m";
  return most_m > 0.0 ? words + " at p " + fixed(p_m, 1) + " m" : words;
}

void draw_numbers(Canvas& canvas, const PaperPoint& at, double room_mm, const Section& section) {
  if (section.lines.empty()) return;
  const SectionAreas& a = section.lines.front();
  const TextStyle style{.size_mm = text_mm, .shorten_mm = room_mm};
  TextStyle coverage = style;
  if (a.coverage < 0.8) coverage.colour = colours::red;
  const auto row = [&](int i, const std::string& words, const TextStyle& s) {
    canvas.text(at + PaperPoint(0.0, i * row_mm), words, s);
  };
  row(0, "design " + fixed(a.design_area_m2, 2) + " m\u00b2   excavated " + fixed(a.area_m2, 2) + " m\u00b2", style);
  row(1, break_words("over ", a.overbreak_m2, a.max_overbreak_m, a.max_overbreak_p_m), style);
  row(2, break_words("under ", a.underbreak_m2, a.max_underbreak_m, a.max_underbreak_p_m), style);
  row(3, "measured " + percent(a.coverage) + "   interpolated " + percent(a.interpolated), coverage);
  row(4, "against " + a.line, style);
}

}  // namespace

std::vector<SectionLine> section_lines(const DesignTunnel& design, double chainage_m) {
  const Polygon profile = design.profile_at(chainage_m).flattened(1e-3);
  std::vector<SectionLine> lines;
  for (const DesignLine& growing : design.lines()) {
    const DesignLine line = design.line_at(growing, chainage_m);
    if (line.offset_m == 0.0) {
      lines.push_back({line.name, 0.0, profile});
      continue;
    }
    std::vector<Polygon> rings = offset_ring(profile, line.offset_m);
    if (!rings.empty()) lines.push_back({line.name, line.offset_m, std::move(rings.front())});
  }
  return lines;
}

std::string section_title(const Section& section) {
  const std::string chainage = fixed(section.chainage_m, 2);
  const std::string station = fixed(section.station_m, 2);
  return "Section " + chainage + (station == chainage ? "" : " (station " + station + ")");
}

void draw_section(Canvas& canvas, const Rect& rect, const Section& section, const std::vector<SectionLine>& lines) {
  canvas.text({rect.left, rect.top}, section_title(section), {.size_mm = 3.0, .bold = true});
  canvas.text({rect.right() - 14.0, rect.top + 0.8},
              section.plane == SectionPlane::vertical ? "vertical plane" : "square to the axis in space",
              {.size_mm = text_mm - 0.1, .colour = colours::grey, .across = Across::right});
  canvas.text({rect.left, rect.top + 4.2},
              "looking up-chainage, metres   axis E " + fixed(section.axis_site.x(), 3) + "  N " +
                  fixed(section.axis_site.y(), 3) + "  H " + fixed(section.axis_site.z(), 3),
              {.size_mm = text_mm - 0.1, .colour = colours::grey});
  const Rect room{rect.left + 5.5, rect.top + 7.6, rect.width - 5.5, rect.height - 7.6 - 4.2 - footer_mm};
  double scale = 0.0;
  const PlotArea area = true_scale_area(room, box_of(section, lines), scale);
  const AxisTexts texts{"", "", text_mm - 0.2, 8, 6, true};
  draw_grid(canvas, area, texts);
  canvas.save();
  canvas.clip(area.rect);
  if (!lines.empty()) {
    const OverUnder areas = over_under(section.outline, lines.front().ring, lines.front().offset_m);
    canvas.fill(on_paper(area, areas.over), colours::overbreak_pale);
    canvas.fill(on_paper(area, areas.under), colours::underbreak_pale);
  }
  draw_axis_cross(canvas, area);
  for (std::size_t i = lines.size(); i-- > 0;)
    canvas.polyline(on_paper(area, lines[i].ring), i == 0 ? excavation_pen : other_line_pen, true);
  const std::vector<OutlineRun> runs = outline_runs(section.outline);
  draw_outline(canvas, area, runs);
  if (!section.lines.empty()) {
    const SectionAreas& a = section.lines.front();
    draw_extreme(canvas, area, section, a.max_overbreak_p_m, a.max_overbreak_m, true);
    draw_extreme(canvas, area, section, a.max_underbreak_p_m, a.max_underbreak_m, false);
  }
  canvas.restore();
  if (section.outline.empty())
    canvas.text(area.at(0.0, 0.0) + PaperPoint(0.0, 4.0), "nothing measured here",
                {.size_mm = text_mm + 0.4, .colour = colours::red, .across = Across::centre, .halo_mm = 0.4});
  draw_axes(canvas, area, texts);
  const double mm_per_m = 1000.0 / scale;
  draw_scale_bar(canvas, {area.rect.right() - 1.0 - mm_per_m * 2.0, area.rect.bottom() - 1.0}, mm_per_m, 2.0 * mm_per_m,
                 text_mm - 0.3);
  canvas.text({rect.right(), rect.top + 0.4}, "1 : " + fixed(scale, 0), {.size_mm = text_mm, .across = Across::right});
  const double key_mm = 30.0;
  const double top = rect.bottom() - footer_mm;
  draw_numbers(canvas, {rect.left, top}, rect.width - key_mm - 1.0, section);
  draw_key(canvas, {rect.right() - key_mm, top}, key_mm, key_of(runs, lines));
}

}  // namespace adit::render
