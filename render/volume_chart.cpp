#include "render/volume_chart.h"

#include <algorithm>

#include "render/axes.h"
#include "render/colour_map.h"
#include "render/map_signs.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.2;
const Pen excess_pen{colours::black, 0.4, {}};

double excess_m2(const Section& section) {
  return section.lines.empty() ? 0.0 : section.lines.front().overbreak_m2 - section.lines.front().underbreak_m2;
}

PlotArea bar_area(const Rect& rect, const std::vector<Section>& sections) {
  double over = 0.0, under = 0.0;
  for (const Section& section : sections)
    if (!section.lines.empty()) {
      over = std::max(over, section.lines.front().overbreak_m2);
      under = std::max(under, section.lines.front().underbreak_m2);
    }
  const double half = sections.size() > 1 ? (sections[1].chainage_m - sections[0].chainage_m) / 2.0 : 0.5;
  const double top = over > 0.0 ? 1.12 * over : 0.1;
  return {rect, sections.front().chainage_m - half, sections.back().chainage_m + half,
          -std::max(1.12 * under, 0.06 * top), top};
}

void draw_bars(Canvas& canvas, const PlotArea& area, const std::vector<Section>& sections) {
  const double zero = area.paper_y(0.0);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (sections[i].lines.empty()) continue;
    const double s = sections[i].chainage_m;
    const double from = i == 0 ? area.x_from : (sections[i - 1].chainage_m + s) / 2.0;
    const double to = i + 1 == sections.size() ? area.x_to : (sections[i + 1].chainage_m + s) / 2.0;
    const double left = area.paper_x(from), width = area.paper_x(to) - left;
    const double over = area.paper_y(sections[i].lines.front().overbreak_m2);
    const double under = area.paper_y(-sections[i].lines.front().underbreak_m2);
    canvas.fill(Rect{left + 0.06 * width, over, 0.88 * width, zero - over}, colours::overbreak);
    canvas.fill(Rect{left + 0.06 * width, zero, 0.88 * width, under - zero}, colours::underbreak);
  }
  canvas.line({area.rect.left, zero}, {area.rect.right(), zero}, {colours::black, 0.2, {}});
}

void draw_round_bounds(Canvas& canvas, const PlotArea& area, const std::vector<JobRound>& rounds) {
  double last_label = -1e9;
  for (const JobRound& round : rounds) {
    const double from = std::max(round.from_m, area.x_from), to = std::min(round.to_m, area.x_to);
    if (to <= from) continue;
    for (double s : {from, to})
      canvas.line({area.paper_x(s), area.rect.top - 1.0}, {area.paper_x(s), area.rect.bottom()},
                  {colours::grey, 0.2, {0.8, 0.8}});
    const double x = (area.paper_x(from) + area.paper_x(to)) / 2.0;
    if (x - last_label < 6.0) continue;
    last_label = x;
    canvas.text({x, area.rect.top - 0.4}, std::to_string(round.number),
                {.size_mm = text_mm, .bold = true, .across = Across::centre, .down = Down::bottom});
  }
}

void draw_excess(Canvas& canvas, const PlotArea& bars, const std::vector<Section>& sections) {
  const std::vector<double> sums = accumulated_excess_m3(sections);
  const auto [low, high] = std::minmax_element(sums.begin(), sums.end());
  // The line has its own axis with the same zero.
  const double reach = std::max(*high, 1e-3) / (0.95 * bars.y_to);
  const double reach_below = -std::min(*low, 0.0) / (-0.95 * bars.y_from);
  PlotArea area = bars;
  const double factor = std::max(reach, reach_below);
  area.y_from = bars.y_from * factor;
  area.y_to = bars.y_to * factor;
  PaperRing points;
  for (std::size_t i = 0; i < sums.size(); ++i) points.push_back(area.at(sections[i].chainage_m, sums[i]));
  canvas.polyline(points, {colours::white, 1.0, {}});
  canvas.polyline(points, excess_pen);
  const Ticks ticks = nice_ticks(area.y_from, area.y_to, 6);
  for (double v : ticks.values) {
    const PaperPoint foot(area.rect.right(), area.paper_y(v));
    canvas.line(foot, foot + PaperPoint(1.0, 0.0), {colours::grey, 0.2, {}});
    canvas.text(foot + PaperPoint(1.4, 0.0), fixed(v, ticks.decimals), {.size_mm = text_mm, .down = Down::middle});
  }
  canvas.text({area.rect.right() + 10.5, area.rect.centre().y()}, "excess added up [m\u00b3]",
              {.size_mm = text_mm,
               .colour = colours::grey,
               .across = Across::centre,
               .down = Down::bottom,
               .turn_rad = M_PI / 2.0});
}

}  // namespace

std::vector<double> accumulated_excess_m3(const std::vector<Section>& sections) {
  std::vector<double> sums(sections.size(), 0.0);
  for (std::size_t i = 1; i < sections.size(); ++i)
    sums[i] = sums[i - 1] + (sections[i].chainage_m - sections[i - 1].chainage_m) *
                                (excess_m2(sections[i]) + excess_m2(sections[i - 1])) / 2.0;
  return sums;
}

void draw_volume_chart(Canvas& canvas, const Rect& rect, const std::vector<Section>& sections,
                       const std::vector<JobRound>& rounds) {
  if (sections.empty()) {
    canvas.text(rect.centre(), "no sections",
                {.colour = colours::grey, .across = Across::centre, .down = Down::middle});
    return;
  }
  const PlotArea area = bar_area({rect.left + 12.0, rect.top + 4.0, rect.width - 26.0, rect.height - 18.0}, sections);
  const AxisTexts texts{"chainage [m]", "area [m\u00b2]", text_mm, 12, 6, true};
  draw_grid(canvas, area, texts);
  draw_bars(canvas, area, sections);
  draw_round_bounds(canvas, area, rounds);
  draw_excess(canvas, area, sections);
  draw_axes(canvas, area, texts);
  const double y = rect.bottom() - 2.2;
  double x = rect.left + 12.0;
  for (const auto& [name, colour] :
       {NamedColour{"overbreak area", colours::overbreak}, NamedColour{"underbreak area", colours::underbreak}}) {
    canvas.fill(Rect{x, y - 1.2, 2.4, 2.4}, colour);
    canvas.text({x + 3.4, y}, name, {.size_mm = text_mm, .down = Down::middle});
    x += 32.0;
  }
  canvas.line({x, y}, {x + 5.0, y}, excess_pen);
  canvas.text({x + 6.0, y}, "excess (over minus under) added up by end areas",
              {.size_mm = text_mm, .down = Down::middle});
}

}  // namespace adit::render
