#include "render/axes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/colour_map.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double tick_mm = 1.0;
const Pen grid_pen{colours::pale_grey, 0.15, {}};
const Pen frame_pen{colours::grey, 0.2, {}};

int decimals_of(double step) {
  int decimals = 0;
  for (double scaled = step; decimals < 6 && std::abs(scaled - std::round(scaled)) > 1e-6 * scaled; scaled *= 10.0)
    ++decimals;
  return decimals;
}

}  // namespace

Ticks nice_ticks(double from, double to, int most) {
  Ticks ticks;
  if (!(to > from)) return ticks;
  ticks.step = round_up((to - from) / std::max(1, most));
  ticks.decimals = decimals_of(ticks.step);
  const double hair = 1e-9 * (to - from);
  const auto first = static_cast<long long>(std::ceil((from - hair) / ticks.step));
  const auto last = static_cast<long long>(std::floor((to + hair) / ticks.step));
  for (long long i = first; i <= last; ++i) ticks.values.push_back(static_cast<double>(i) * ticks.step);
  return ticks;
}

PlotArea true_scale_area(const Rect& room, const Eigen::AlignedBox2d& box, double& scale_denominator) {
  static constexpr std::array round_scales{1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 7.5, 10.0};
  const Eigen::Vector2d size = box.sizes().cwiseMax(1e-3);
  const double least = 1000.0 * std::max(size.x() / room.width, size.y() / room.height);
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  scale_denominator = 10.0 * power;
  for (double s : round_scales)
    if (s * power >= least * (1.0 - 1e-9)) {
      scale_denominator = s * power;
      break;
    }
  const Eigen::Vector2d half = Eigen::Vector2d(room.width, room.height) * scale_denominator / 2000.0;
  const Eigen::Vector2d middle = box.center();
  return {room, middle.x() - half.x(), middle.x() + half.x(), middle.y() - half.y(), middle.y() + half.y()};
}

void draw_grid(Canvas& canvas, const PlotArea& area, const AxisTexts& texts) {
  for (double x : nice_ticks(area.x_from, area.x_to, texts.most_x).values)
    canvas.line({area.paper_x(x), area.rect.top}, {area.paper_x(x), area.rect.bottom()}, grid_pen);
  for (double y : nice_ticks(area.y_from, area.y_to, texts.most_y).values)
    canvas.line({area.rect.left, area.paper_y(y)}, {area.rect.right(), area.paper_y(y)}, grid_pen);
}

void draw_axes(Canvas& canvas, const PlotArea& area, const AxisTexts& texts) {
  const double text = texts.text_mm;
  canvas.frame(area.rect, frame_pen);
  const Ticks x_ticks = nice_ticks(area.x_from, area.x_to, texts.most_x);
  for (double x : x_ticks.values) {
    const PaperPoint foot(area.paper_x(x), area.rect.bottom());
    canvas.line(foot, foot + PaperPoint(0.0, tick_mm), frame_pen);
    canvas.text(foot + PaperPoint(0.0, tick_mm + 0.3), fixed(x, x_ticks.decimals),
                {.size_mm = text, .across = Across::centre, .down = Down::top});
  }
  const Ticks y_ticks = nice_ticks(area.y_from, area.y_to, texts.most_y);
  double widest = 0.0;
  for (double y : y_ticks.values) {
    const PaperPoint foot(area.rect.left, area.paper_y(y));
    const std::string label = fixed(y, y_ticks.decimals);
    canvas.line(foot, foot - PaperPoint(tick_mm, 0.0), frame_pen);
    const TextStyle style{.size_mm = text, .across = Across::right, .down = Down::middle};
    canvas.text(foot - PaperPoint(tick_mm + 0.5, 0.0), label, style);
    widest = std::max(widest, canvas.text_size(label, style).x());
  }
  canvas.text({area.rect.centre().x(), area.rect.bottom() + tick_mm + 0.5 + 1.3 * text}, texts.x,
              {.size_mm = text, .colour = colours::grey, .across = Across::centre, .down = Down::top});
  canvas.text({area.rect.left - tick_mm - 1.2 - widest, area.rect.centre().y()}, texts.y,
              {.size_mm = text,
               .colour = colours::grey,
               .across = Across::centre,
               .down = Down::bottom,
               .turn_rad = -M_PI / 2.0});
}

}  // namespace adit::render
