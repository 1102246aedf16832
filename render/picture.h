#pragma once
// A picture in memory, its PNG bytes, and how alike two pictures are.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace adit::render {

/// 8-bit RGBA, not premultiplied, rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;

  std::array<std::uint8_t, 4> pixel(int x, int y) const {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
  }
  void set_pixel(int x, int y, const std::array<std::uint8_t, 4>& value) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
    for (std::size_t i = 0; i < 4; ++i) rgba[at + i] = value[i];
  }
};

/// A picture of one colour.
Picture blank_picture(int width, int height, const std::array<std::uint8_t, 4>& colour = {255, 255, 255, 255});

/// The same picture gives the same bytes.
std::string png_bytes(const Picture& picture);

/// Throws Error when the bytes are no PNG.
Picture picture_from_png(const std::string& bytes);

/// Mean structural similarity of the luminance (Wang et al. 2004) over windows of 8 x 8 pixels, every fourth pixel:
/// 1 for equal pictures, near 0 for unlike ones. Throws Error when the sizes differ.
double structural_similarity(const Picture& a, const Picture& b);

}  // namespace adit::render
