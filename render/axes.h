#pragma once
// Numbers to paper: nice ticks, a frame with labels, a grid.

#include <string>
#include <vector>

#include "render/canvas.h"

namespace adit::render {

/// Round numbers inside [from, to], at most `most` of them (one at least where the interval holds a round number).
struct Ticks {
  std::vector<double> values;
  double step = 1.0;
  int decimals = 0;  ///< that the values need
};
Ticks nice_ticks(double from, double to, int most);

/// A rectangle on the paper with a range of numbers on each side; y grows upwards.
struct PlotArea {
  Rect rect;
  double x_from = 0.0;
  double x_to = 1.0;
  double y_from = 0.0;
  double y_to = 1.0;

  double paper_x(double x) const { return rect.left + (x - x_from) / (x_to - x_from) * rect.width; }
  double paper_y(double y) const { return rect.bottom() - (y - y_from) / (y_to - y_from) * rect.height; }
  PaperPoint at(double x, double y) const { return {paper_x(x), paper_y(y)}; }
  PaperPoint at(const Eigen::Vector2d& p) const { return at(p.x(), p.y()); }
};

/// An area inside `room` in which a metre is as long along x as along y and the map scale 1:n is round. The ranges
/// hold at least the box and are widened about its middle to fill the room.
PlotArea true_scale_area(const Rect& room, const Eigen::AlignedBox2d& box, double& scale_denominator);

struct AxisTexts {
  std::string x;
  std::string y;
  double text_mm = 2.3;
  int most_x = 10;
  int most_y = 6;
  bool grid = true;
};

/// Grid lines (drawn first, beneath the content).
void draw_grid(Canvas& canvas, const PlotArea& area, const AxisTexts& texts);

/// Frame, ticks and labels left of and below the area. Needs about 11 mm on the left and 9 mm below.
void draw_axes(Canvas& canvas, const PlotArea& area, const AxisTexts& texts);

}  // namespace adit::render
