#pragma once
// The unrolled map: chainage along, the design line across, deviations in classes of colour.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/job/job.h"
#include "core/profiling/deviation_map.h"
#include "render/canvas.h"
#include "render/colour_map.h"
#include "render/map_signs.h"

namespace adit::render {

/// A place along the design line that gets a tick: q of the map and the arc length p to print.
struct LineMark {
  double q_m = 0.0;
  std::string label;
  bool strong = false;  ///< crown and corners: a line across the map
};

/// What stands around the map.
struct MapTexts {
  std::string line = "profile";  ///< the line the deviations are from
  std::vector<LineMark> marks;
  std::vector<JobRound> rounds;
  LegendWords words = {};
  bool neutral_within_spread = false;  ///< a map of changes: what is no more than its level of detection is grey
};

/// Ticks every few metres of p, the crown and the corners, of the profile at the middle of the map.
std::vector<LineMark> line_marks(const DesignTunnel& design, const DeviationMap& map);

/// All seen deviations of the map, to choose classes from.
std::vector<float> seen_deviations(const DeviationMap& map);

/// Height [mm] the drawing needs at a width.
double deviation_map_height(const DeviationMap& map, double width_mm);

/// A strip of the drawn map: its place on the paper, chainage from its left to its right rim.
struct MapStrip {
  Rect rect;
  double from_m = 0.0;
  double to_m = 0.0;
};

/// Where draw_deviation_map() puts the strips in a rectangle.
std::vector<MapStrip> map_strips(const Rect& rect, const DeviationMap& map);

/// Draws the map (long ones in strips below each other) with axes and legend. Left wall on top, crown in the middle,
/// chainage to the right: the tunnel as seen from above, opened at the floor. Unseen cells are hatched, interpolated
/// ones pale and dotted.
void draw_deviation_map(Canvas& canvas, const Rect& rect, const DeviationMap& map, const DeviationScale& scale,
                        const MapTexts& texts);

}  // namespace adit::render
