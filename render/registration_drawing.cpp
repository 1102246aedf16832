#include "render/registration_drawing.h"

#include <algorithm>

#include "render/axes.h"
#include "render/number_text.h"

namespace adit::render {
namespace {

constexpr double text_mm = 2.2;
constexpr double step_mm = 3.4;
constexpr double names_mm = 45.0;
constexpr double below_mm = 9.0;

}  // namespace

double pair_bars_height(std::size_t pairs) {
  return static_cast<double>(pairs) * step_mm + below_mm;
}

void draw_pair_bars(Canvas& canvas, const Rect& rect, std::vector<PairResult> pairs) {
  if (pairs.empty()) return;
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairResult& a, const PairResult& b) { return a.rms_m > b.rms_m; });
  const auto room = static_cast<std::size_t>(std::max(1.0, (rect.height - below_mm) / step_mm + 1e-6));
  const std::size_t shown = std::min(room, pairs.size());
  const double most_mm = std::max(1.0, 1100.0 * pairs.front().rms_m);
  const PlotArea area{
      {rect.left + names_mm, rect.top, rect.width - names_mm - 20.0, static_cast<double>(shown) * step_mm},
      0.0,
      most_mm,
      0.0,
      1.0};
  for (double v : nice_ticks(0.0, most_mm, 8).values)
    canvas.line({area.paper_x(v), area.rect.top}, {area.paper_x(v), area.rect.bottom()},
                {colours::pale_grey, 0.15, {}});
  for (std::size_t i = 0; i < shown; ++i) {
    const PairResult& pair = pairs[i];
    const double y = rect.top + (static_cast<double>(i) + 0.5) * step_mm;
    canvas.save();
    canvas.clip({rect.left, y - step_mm, names_mm - 1.0, 2.0 * step_mm});
    canvas.text({rect.left, y}, pair.source + " on " + pair.target, {.size_mm = text_mm, .down = Down::middle});
    canvas.restore();
    canvas.fill(Rect{area.rect.left, y - 1.0, area.paper_x(1000.0 * pair.rms_m) - area.rect.left, 2.0},
                pair.used ? Colour{0.35, 0.55, 0.75} : colours::light_grey);
    const double median = area.paper_x(1000.0 * pair.median_m);
    canvas.line({median, y - 1.3}, {median, y + 1.3}, {colours::black, 0.4, {}});
    const double end = area.paper_x(1000.0 * pair.rms_m);
    const double words_mm = pair.used ? 7.0 : 17.0;  // beside the frame where they would run through it
    canvas.text({(end + words_mm > area.rect.right() ? std::max(end, area.rect.right()) : end) + 0.8, y},
                fixed(1000.0 * pair.rms_m, 1) + (pair.used ? "" : " not used"),
                {.size_mm = text_mm, .down = Down::middle});
  }
  const Ticks ticks = nice_ticks(0.0, most_mm, 8);
  canvas.frame(area.rect, {colours::grey, 0.2, {}});
  for (double v : ticks.values)
    canvas.text({area.paper_x(v), area.rect.bottom() + 0.6}, fixed(v, ticks.decimals),
                {.size_mm = text_mm, .across = Across::centre});
  std::string words = "point-to-plane residuals [mm]: bar rms, tick median";
  if (shown < pairs.size()) words += "; " + std::to_string(pairs.size() - shown) + " better pairs not shown";
  canvas.text({area.rect.left, area.rect.bottom() + 3.8}, words, {.size_mm = text_mm, .colour = colours::grey});
}

}  // namespace adit::render
