#include "render/picture.h"

#include "core/foundation/error.h"

namespace adit::render {
namespace {

constexpr int window = 8;

double luminance(const Picture& picture, int x, int y) {
  const auto p = picture.pixel(x, y);
  const double over_white = p[3] / 255.0;
  const double grey = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
  return grey * over_white + 255.0 * (1.0 - over_white);
}

double window_similarity(const Picture& a, const Picture& b, int left, int top) {
  double sum_a = 0.0, sum_b = 0.0, sum_aa = 0.0, sum_bb = 0.0, sum_ab = 0.0;
  for (int y = top; y < top + window; ++y)
    for (int x = left; x < left + window; ++x) {
      const double va = luminance(a, x, y);
      const double vb = luminance(b, x, y);
      sum_a += va;
      sum_b += vb;
      sum_aa += va * va;
      sum_bb += vb * vb;
      sum_ab += va * vb;
    }
  constexpr double n = window * window;
  constexpr double c1 = (0.01 * 255.0) * (0.01 * 255.0);
  constexpr double c2 = (0.03 * 255.0) * (0.03 * 255.0);
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double variance_a = sum_aa / n - mean_a * mean_a;
  const double variance_b = sum_bb / n - mean_b * mean_b;
  const double covariance = sum_ab / n - mean_a * mean_b;
  return (2.0 * mean_a * mean_b + c1) * (2.0 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

}  // namespace

Picture blank_picture(int width, int height, const std::array<std::uint8_t, 4>& colour) {
  Picture picture{width, height, {}};
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  picture.rgba.reserve(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) picture.rgba.insert(picture.rgba.end(), colour.begin(), colour.end());
  return picture;
}

double structural_similarity(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error("two pictures of different size cannot be compared: " + std::to_string(a.width) + " x " +
                std::to_string(a.height) + " and " + std::to_string(b.width) + " x " + std::to_string(b.height));
  double sum = 0.0;
  std::size_t windows = 0;
  for (int top = 0; top + window <= a.height; top += window / 2)
    for (int left = 0; left + window <= a.width; left += window / 2) {
      sum += window_similarity(a, b, left, top);
      ++windows;
    }
  if (windows == 0) throw Error("a picture smaller than 8 x 8 pixels cannot be compared");
  return sum / static_cast<double>(windows);
}

}  // namespace adit::render
