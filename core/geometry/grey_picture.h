#pragma once
// A picture in shades of grey, and its values between the pixels.

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace adit {

/// 8 bits a pixel, rows from the top. (0, 0) is the centre of the first pixel, u runs right, v down.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  GreyPicture() = default;
  GreyPicture(int columns, int rows, std::uint8_t value = 0)
      : width(columns),
        height(rows),
        pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}

  std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  std::uint8_t at(int u, int v) const { return pixels[index(u, v)]; }
  /// True where the four pixels about a place exist.
  bool holds(double u, double v) const { return u >= 0.0 && v >= 0.0 && u < width - 1.0 && v < height - 1.0; }
  /// Bilinear; the place must be held.
  double between(double u, double v) const {
    const int i = static_cast<int>(u), j = static_cast<int>(v);
    const double a = u - i, b = v - j;
    const std::uint8_t* row = pixels.data() + index(i, j);
    const std::uint8_t* next = row + width;
    return (1.0 - b) * ((1.0 - a) * row[0] + a * row[1]) + b * ((1.0 - a) * next[0] + a * next[1]);
  }
};

/// A grey value that was measured beside the middle of a pixel.
struct GreySample {
  double u = 0.0, v = 0.0;
  double grey = 0.0;
};

}  // namespace adit
