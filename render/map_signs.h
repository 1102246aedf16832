#pragma once
// The small signs of a plan: scale bar, north arrow, colour legend.

#include <string>
#include <vector>

#include "render/canvas.h"
#include "render/colour_map.h"

namespace adit::render {

/// A bar of a round length in metres, at most room_mm wide; `at` is its lower left corner. Returns its length on paper.
double draw_scale_bar(Canvas& canvas, const PaperPoint& at, double mm_per_m, double room_mm, double text_mm = 2.2);

/// An arrow to the north about `centre`; clockwise_rad is the direction of north on the paper, from up.
void draw_north_arrow(Canvas& canvas, const PaperPoint& centre, double length_mm, double clockwise_rad);

/// A value that is marked on a legend.
struct LegendMark {
  double value_m = 0.0;
  std::string name;
};

/// What stands over the two sides of a legend, and what is marked under it.
struct LegendWords {
  std::string below = "underbreak";
  std::string above = "overbreak";
  std::vector<LegendMark> marks = {};
};

/// Boxes of the classes side by side, pointed at the ends (and beyond), with their boundaries in cm below and
/// the words above. About 10 mm high; `rect` gives the place and the width.
void draw_deviation_legend(Canvas& canvas, const Rect& rect, const DeviationScale& scale, double text_mm = 2.3,
                           const LegendWords& words = {});

/// Coloured squares with names, one below the other, from the upper left corner.
struct NamedColour {
  std::string name;
  Colour colour;
};
void draw_names(Canvas& canvas, const PaperPoint& at, const std::vector<NamedColour>& names, double text_mm = 2.3);

}  // namespace adit::render
