#include "render/map_signs.h"

#include <algorithm>
#include <cmath>

#include "render/number_text.h"

namespace adit::render {

double draw_scale_bar(Canvas& canvas, const PaperPoint& at, double mm_per_m, double room_mm, double text_mm) {
  const double length_m = round_down(room_mm / mm_per_m);
  const double length_mm = length_m * mm_per_m;
  const double height = 0.4 * text_mm;
  const Pen pen{colours::black, 0.15, {}};
  const Rect bar{at.x(), at.y() - height, length_mm, height};
  canvas.fill(bar, colours::white);
  canvas.fill(Rect{bar.left, bar.top, length_mm / 2.0, height}, colours::black);
  canvas.frame(bar, pen);
  const std::string label = length_m < 1.0
                                ? fixed(100.0 * length_m, length_m < 0.1 ? 1 : 0) + " cm"
                                : fixed(length_m, std::abs(length_m - std::round(length_m)) > 1e-6 ? 1 : 0) + " m";
  canvas.text({bar.right(), bar.top - 0.3}, label,
              {.size_mm = text_mm, .across = Across::right, .down = Down::bottom, .halo_mm = 0.3});
  canvas.text({bar.left, bar.top - 0.3}, "0", {.size_mm = text_mm, .down = Down::bottom, .halo_mm = 0.3});
  return length_mm;
}

void draw_north_arrow(Canvas& canvas, const PaperPoint& centre, double length_mm, double clockwise_rad) {
  const PaperPoint up(std::sin(clockwise_rad), -std::cos(clockwise_rad));
  const PaperPoint side(-up.y(), up.x());
  const double half = length_mm / 2.0;
  canvas.fill({{centre + up * half, centre - up * half + side * (0.3 * half), centre - up * (0.6 * half)}},
              colours::black);
  canvas.polyline({centre + up * half, centre - up * half - side * (0.3 * half), centre - up * (0.6 * half)},
                  {colours::black, 0.2, {}}, true);
  canvas.text(centre + up * (half + 1.8), "N",
              {.size_mm = 2.6, .bold = true, .across = Across::centre, .down = Down::middle, .halo_mm = 0.3});
}

void draw_deviation_legend(Canvas& canvas, const Rect& rect, const DeviationScale& scale, double text_mm,
                           const LegendWords& words) {
  const std::vector<double> boundaries = scale.boundaries_m();
  const double box_width = rect.width / static_cast<double>(boundaries.size() - 1);
  const double top = rect.top + 1.35 * text_mm, height = 3.2, bottom = top + height;
  const int decimals = std::abs(100.0 * scale.step_m - std::round(100.0 * scale.step_m)) > 1e-6 ? 1 : 0;
  double zero = rect.left;
  for (std::size_t i = 0; i < boundaries.size(); ++i) {
    const double x = rect.left + static_cast<double>(i) * box_width;
    if (std::abs(boundaries[i]) < 1e-9) zero = x;
    if (i + 1 < boundaries.size()) {
      PaperRing box = ring_of({x, top, box_width, height});
      if (i == 0) box.emplace_back(x - 2.0, (top + bottom) / 2.0);
      if (i + 2 == boundaries.size())
        box.insert(box.begin() + 2, PaperPoint(x + box_width + 2.0, (top + bottom) / 2.0));
      canvas.fill({box}, deviation_colour(scale, (boundaries[i] + boundaries[i + 1]) / 2.0));
      canvas.polyline(box, {colours::grey, 0.12, {}}, true);
    }
    canvas.text({x, bottom + 0.3}, with_sign(100.0 * boundaries[i], decimals),
                {.size_mm = text_mm, .across = Across::centre});
  }
  canvas.text({rect.right() + 5.0, bottom + 0.3}, "cm", {.size_mm = text_mm});
  for (const LegendMark& mark : words.marks) {
    if (mark.value_m < boundaries.front() || mark.value_m > boundaries.back()) continue;
    const double x = rect.left + (mark.value_m - boundaries.front()) / scale.step_m * box_width;
    canvas.line({x, top - 0.6}, {x, bottom + 3.2}, {colours::black, 0.3, {}});
    canvas.text({x, bottom + 3.3}, mark.name, {.size_mm = text_mm, .bold = true, .across = Across::centre});
  }
  canvas.text({zero - 1.0, rect.top}, words.below,
              {.size_mm = text_mm, .colour = colours::underbreak, .across = Across::right});
  canvas.text({zero + 1.0, rect.top}, words.above, {.size_mm = text_mm, .colour = colours::red});
}

void draw_names(Canvas& canvas, const PaperPoint& at, const std::vector<NamedColour>& names, double text_mm) {
  double y = at.y();
  for (const auto& [name, colour] : names) {
    canvas.fill(Rect{at.x(), y + 0.15 * text_mm, text_mm, text_mm}, colour);
    canvas.text({at.x() + 1.6 * text_mm, y}, name, {.size_mm = text_mm, .halo_mm = 0.3});
    y += 1.5 * text_mm;
  }
}

}  // namespace adit::render
