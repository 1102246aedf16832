#pragma once
// How large a drawing of render/ is when it fills a part of the screen.

#include <imgui.h>

#include <algorithm>

#include "render/canvas.h"

namespace adit::ui {

struct Paper {
  double dots_per_inch = 96.0;
  double width_mm = 0.0;
  double height_mm = 0.0;

  double pixels_per_mm() const { return dots_per_inch / 25.4; }
  render::Rect rect() const { return {0.0, 0.0, width_mm, height_mm}; }
};

/// Paper of so many pixels on which letters of 2.2 mm are as large as the theme's; a small one gets smaller letters, so
/// that no side is shorter than 75 mm.
inline Paper paper_of(const ImVec2& size_px, float scale) {
  const double least_px = std::max(1.0, static_cast<double>(std::min(size_px.x, size_px.y)));
  Paper paper;
  paper.dots_per_inch = std::min(140.0 * static_cast<double>(scale), least_px * 25.4 / 75.0);
  paper.width_mm = static_cast<double>(size_px.x) / paper.pixels_per_mm();
  paper.height_mm = static_cast<double>(size_px.y) / paper.pixels_per_mm();
  return paper;
}

}  // namespace adit::ui
