#pragma once
// Cross-cuts and deep niches in a deviation map: places where there is no rock within reach, but points beyond it.

#include <vector>

#include "core/profiling/deviation_map.h"

namespace adit {

struct Opening {
  double area_m2 = 0.0;  ///< of the line
  double from_m = 0.0;   ///< chainage
  double to_m = 0.0;
  double clock_deg = 0.0;  ///< where the line's normal points in its middle
};

/// The openings of a map, in order of their first row. What lies behind an opening is far and its points are sparse:
/// unseen cells with three marked ones within 0.3 m are open, too, and so are cells there whose points spread over more
/// than 0.3 m: its roof, floor and walls, seen end on. Patches under half a square metre are something else
/// (a reflection, a drill hole, a gap in a shadow) and become unseen.
/// stretch_of_row: index into stretches for every row.
std::vector<Opening> find_openings(DeviationMap& map, const std::vector<ProfileStretch>& stretches,
                                   const std::vector<std::size_t>& stretch_of_row);

}  // namespace adit
