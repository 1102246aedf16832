#include "render/ring_drawing.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "render/axes.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.2;

/// The deviations of one direction.
struct Curve {
  const char* name;
  double RingResult::*deviation;
  Colour colour;
};

const Curve curves[] = {{"horizontal, right positive", &RingResult::horizontal_deviation_m, colours::ink_blue},
                        {"vertical, up positive", &RingResult::vertical_deviation_m, colours::overbreak}};

double two_sigmas_mm(const RingResult& ring) {
  return std::isfinite(ring.sigma_center_m) ? 2e3 * ring.sigma_center_m : 0.0;
}

PlotArea area_of(const Rect& rect, const std::vector<RingResult>& rings) {
  double low = -1.0, high = 1.0;
  for (const RingResult& ring : rings)
    for (const Curve& curve : curves) {
      low = std::min(low, 1e3 * ring.*curve.deviation - two_sigmas_mm(ring));
      high = std::max(high, 1e3 * ring.*curve.deviation + two_sigmas_mm(ring));
    }
  const double margin = 0.05 * (high - low);
  const double ends = std::max(0.5, 0.02 * (rings.back().chainage_m - rings.front().chainage_m));
  return {rect, rings.front().chainage_m - ends, rings.back().chainage_m + ends, low - margin, high + margin};
}

/// Where a clock direction points on the paper, looking up-chainage.
Eigen::Vector2d way(double clock_deg) {
  const double angle = rad_from_deg(clock_deg);
  return {std::sin(angle), -std::cos(angle)};
}

}  // namespace

void draw_ring_deviations(Canvas& canvas, const Rect& rect, const std::vector<RingResult>& rings) {
  if (rings.empty()) return;
  const PlotArea area = area_of({rect.left + 12.0, rect.top + 5.0, rect.width - 14.0, rect.height - 15.0}, rings);
  const AxisTexts texts{"chainage [m]", "deviation [mm]", text_mm, 12, 8, true};
  draw_grid(canvas, area, texts);
  canvas.line(area.at(area.x_from, 0.0), area.at(area.x_to, 0.0), {colours::black, 0.2, {}});
  double x = area.rect.left;
  for (const Curve& curve : curves) {
    PaperRing line;
    for (const RingResult& ring : rings) {
      const double mm = 1e3 * ring.*curve.deviation;
      line.push_back(area.at(ring.chainage_m, mm));
      const double reach = two_sigmas_mm(ring);
      canvas.line(area.at(ring.chainage_m, mm - reach), area.at(ring.chainage_m, mm + reach), {curve.colour, 0.2, {}});
      canvas.fill(Rect{line.back().x() - 0.5, line.back().y() - 0.5, 1.0, 1.0}, curve.colour);
    }
    canvas.polyline(line, {curve.colour, 0.35, {}});
    canvas.fill(Rect{x, rect.top + 1.0, 3.0, 1.4}, curve.colour);
    canvas.text({x + 4.0, rect.top + 1.7}, curve.name, {.size_mm = text_mm, .down = Down::middle});
    x += 48.0;
  }
  canvas.text({x, rect.top + 1.7}, "bars: \u00b1 2 sigma", {.size_mm = text_mm, .down = Down::middle});
  draw_axes(canvas, area, texts);
}

void draw_ring(Canvas& canvas, const Rect& rect, const RingResult& ring, double largest_m) {
  const PaperPoint centre(rect.centre().x(), rect.top + 0.5 * (rect.height + 6.0));
  const double radius = 0.36 * std::min(rect.width, rect.height - 6.0);
  constexpr int corners = 120;
  PaperRing circle;
  for (int i = 0; i <= corners; ++i) circle.push_back(centre + radius * way(360.0 * i / corners));
  canvas.polyline(circle, {colours::grey, 0.3, {}});
  canvas.line(centre - PaperPoint(1.5, 0.0), centre + PaperPoint(1.5, 0.0), {colours::grey, 0.2, {}});
  canvas.line(centre - PaperPoint(0.0, 1.5), centre + PaperPoint(0.0, 1.5), {colours::grey, 0.2, {}});
  for (const RingResidual& residual : ring.residuals) {
    const Eigen::Vector2d out = way(residual.clock_deg);
    const double long_mm = largest_m > 0.0 ? 0.2 * radius * residual.residual_m / largest_m : 0.0;
    const Colour colour = residual.residual_m > 0.0 ? colours::overbreak : colours::underbreak;
    canvas.line(centre + radius * out, centre + (radius + long_mm) * out, {colour, 0.7, {}});
    const double text_at = radius + std::max(long_mm, 0.0) + 2.6;
    canvas.text(centre + text_at * out, with_sign(1e3 * residual.residual_m, 1),
                {.size_mm = 1.9, .across = Across::centre, .down = Down::middle});
  }
  canvas.text({rect.left + 1.0, rect.top}, "Ring " + ring.ring + "  " + fixed(ring.chainage_m, 3) + " m",
              {.size_mm = 2.4, .bold = true, .shorten_mm = rect.width - 2.0});
  canvas.text(centre + PaperPoint(0.0, 3.0),
              "R " + fixed(ring.radius_m, 4) + " m\nh " + with_sign(1e3 * ring.horizontal_deviation_m, 1) + "  v " +
                  with_sign(1e3 * ring.vertical_deviation_m, 1) + " mm",
              {.size_mm = 1.9, .across = Across::centre, .wrap_mm = 1.6 * radius});
}

}  // namespace adit::render
