#pragma once
// One row of the deviation map as an outline in the section plane.

#include <vector>

#include "core/geometry/polygon.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/section.h"

namespace adit {

/// The outline of a row and how much of the line it rests on.
struct Outline {
  std::vector<OutlinePoint> points;  ///< closed, clockwise looking up-chainage, about every 2 cm of the line
  std::vector<MapCell> cells;        ///< the row with its gaps filled: kind says how
  double measured_m = 0.0;           ///< length of the line that was measured ...
  double interpolated_m = 0.0;       ///< ... interpolated over gaps up to gap_m ...
  double unseen_m = 0.0;             ///< ... not seen; there the outline follows the line ...
  double opening_m = 0.0;            ///< ... and open: there it follows the line, too
};

/// Between measured cells deviations are interpolated along the line; so are gaps up to gap_m, which are marked
/// interpolated; gaps that are longer, along the line or straight between their measured ends, stay unseen. Gaps that
/// are open over half their length or more are never bridged.
Outline outline_of(const std::vector<MapCell>& row, const ProfileStretch& stretch, double step_q_m, double gap_m);

/// The outline as a polygon for a line at an offset: where there is no rock it runs on that line.
Polygon polygon_of(const std::vector<OutlinePoint>& points, double line_offset_m);

}  // namespace adit
