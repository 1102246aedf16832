#include "tests/bench/box_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/geometry/statistics.h"
#include "render/canvas.h"

namespace adit::bench {
namespace {

using render::Canvas;
using render::Colour;
using render::PaperPoint;
using render::Rect;
namespace colours = render::colours;

constexpr double row_mm = 9.0;
constexpr double names_mm = 52.0;
constexpr double plot_mm = 100.0;
constexpr double title_mm = 8.0;

/// The decades that hold all values.
struct LogAxis {
  double from = 0.0, to = 1.0;  ///< powers of ten
  explicit LogAxis(const std::vector<Sample>& samples) {
    double least = 1e300, most = 0.0;
    for (const Sample& sample : samples)
      for (const double value : sample.values) {
        least = std::min(least, value);
        most = std::max(most, value);
      }
    from = std::floor(std::log10(least));
    to = std::max(from + 1.0, std::ceil(std::log10(most)));
  }
  double x(double value) const { return names_mm + plot_mm * (std::log10(value) - from) / (to - from); }
};

void draw_box(Canvas& canvas, const LogAxis& axis, const Sample& sample, double y) {
  const double q1 = quantile(sample.values, 0.25);
  const double q3 = quantile(sample.values, 0.75);
  const double reach = 1.5 * (q3 - q1);
  double low = q1, high = q3;
  for (const double value : sample.values) {
    if (value >= q1 - reach) low = std::min(low, value);
    if (value <= q3 + reach) high = std::max(high, value);
  }
  const render::Pen thin{colours::black, 0.25, {}};
  canvas.line({axis.x(low), y}, {axis.x(q1), y}, thin);
  canvas.line({axis.x(q3), y}, {axis.x(high), y}, thin);
  for (const double end : {low, high}) canvas.line({axis.x(end), y - 1.2}, {axis.x(end), y + 1.2}, thin);
  const Rect box{axis.x(q1), y - 2.2, std::max(0.2, axis.x(q3) - axis.x(q1)), 4.4};
  canvas.fill(box, colours::underbreak_pale);
  canvas.frame(box, thin);
  const double middle = axis.x(median(sample.values));
  canvas.line({middle, y - 2.2}, {middle, y + 2.2}, {colours::black, 0.8, {}});
  for (const double value : sample.values)
    if (value < low || value > high) canvas.disc({axis.x(value), y}, 0.45, colours::red);
}

std::string power_of_ten(double exponent) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", std::pow(10.0, exponent));
  return text;
}

}  // namespace

render::Picture box_plot(const std::string& title, const std::string& axis_name, const std::vector<Sample>& samples,
                         std::optional<double> mark) {
  const double plot_height = row_mm * static_cast<double>(samples.size());
  Canvas canvas = Canvas::raster(names_mm + plot_mm + 8.0, title_mm + plot_height + 12.0, 120.0);
  const LogAxis axis(samples);
  canvas.text({1.0, 1.5}, title, {.size_mm = 3.2, .bold = true});
  const Rect area{names_mm, title_mm, plot_mm, plot_height};
  for (double exponent = axis.from; exponent <= axis.to; exponent += 1.0) {
    const double x = axis.x(std::pow(10.0, exponent));
    canvas.line({x, area.top}, {x, area.bottom()}, {colours::light_grey, 0.2, {}});
    canvas.text({x, area.bottom() + 0.8}, power_of_ten(exponent), {.size_mm = 2.6, .across = render::Across::centre});
  }
  canvas.text({names_mm + 0.5 * plot_mm, area.bottom() + 5.0}, axis_name,
              {.size_mm = 2.8, .across = render::Across::centre});
  if (mark) {
    const double x = axis.x(*mark);
    canvas.line({x, area.top}, {x, area.bottom()}, {colours::green, 0.3, {1.5, 1.0}});
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double y = area.top + (static_cast<double>(i) + 0.5) * row_mm;
    canvas.text({names_mm - 2.0, y}, samples[i].name,
                {.size_mm = 2.8, .across = render::Across::right, .down = render::Down::middle});
    draw_box(canvas, axis, samples[i], y);
  }
  canvas.frame(area, {colours::grey, 0.25, {}});
  return canvas.finish_picture();
}

}  // namespace adit::bench
