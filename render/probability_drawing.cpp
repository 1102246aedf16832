#include "render/probability_drawing.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/statistics.h"
#include "render/canvas.h"
#include "render/map_signs.h"

namespace adit::render {
namespace {

constexpr double pixel_mm = 0.25;
constexpr double beneath_mm = 12.5;  // two lines of words
constexpr double least_width_mm = 90.0;

/// From black over blue and orange to white.
Colour glow(double share) {
  constexpr Colour stops[] = {{0.02, 0.02, 0.06}, {0.10, 0.20, 0.50}, {0.85, 0.45, 0.20}, {1.0, 0.97, 0.80}};
  const double at = std::clamp(share, 0.0, 1.0) * 3.0;
  const int below = std::min(2, static_cast<int>(at));
  return mixed(stops[below], stops[below + 1], at - below);
}

/// Of the pixels that points reach.
double full_density(const ProbabilityImage& image) {
  const float most = *std::max_element(image.density_per_m2.begin(), image.density_per_m2.end());
  std::vector<double> reached;
  for (const float density : image.density_per_m2)
    if (density > 1e-3F * most) reached.push_back(static_cast<double>(density));
  return reached.empty() ? 1.0 : quantile(reached, 0.99);
}

Picture pixels_of(const ProbabilityImage& image) {
  Picture picture = blank_picture(image.width, image.height);
  const double full = full_density(image);
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const Colour c = glow(std::sqrt(static_cast<double>(image.at(column, row)) / full));
      const auto byte = [](double x) { return static_cast<std::uint8_t>(std::lround(255.0 * x)); };
      picture.set_pixel(column, image.height - 1 - row, {byte(c.red), byte(c.green), byte(c.blue), 255});
    }
  return picture;
}

}  // namespace

Picture probability_picture(const ProbabilityImage& image, const std::string& words) {
  const double width = image.width * pixel_mm;
  const double height = image.height * pixel_mm;
  const double paper = std::max(width, least_width_mm);
  Canvas canvas = Canvas::raster(paper, height + beneath_mm, 25.4 / pixel_mm);
  canvas.picture(pixels_of(image), {0.0, 0.0, width, height}, false);
  draw_scale_bar(canvas, {2.0, height + 4.8}, pixel_mm / image.pixel_m, 0.25 * paper, 2.6);
  canvas.text({2.0, height + 5.4}, words, {.size_mm = 2.4, .wrap_mm = paper - 4.0});
  return canvas.finish_picture();
}

}  // namespace adit::render
