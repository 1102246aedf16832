#pragma once
// What a blasting round did to its contour.

#include <limits>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"

namespace adit {

/// Of the measured cells of a round whose normal does not point downwards (105 degrees from straight up and more: the
/// floor is muck and tells nothing of the holes), against one line. What is not known is not a number.
struct RoundReview {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double lookout_collar_m = unknown;      ///< mean deviation at the round's beginning, by regression over the chainage
  double lookout_toe_m = unknown;         ///< ... at its end
  double lookout_per_m = unknown;         ///< slope: outwards per metre of round
  double lookout_sigma_per_m = unknown;   ///< from how blocks of 3 m of the contour differ
  double contour_ratio = unknown;         ///< length of the as-built outline over that of the line, mean of the slices
  double overbreak_area_sd_m2 = unknown;  ///< standard deviation of the slices' overbreak areas: longitudinal variation
  double affected_share = unknown;        ///< share of the cells that lie outside the line
  double mean_overbreak_m = unknown;      ///< mean depth of those
};

/// Rows of the map whose middle lies in [from, to]. Unknown where fewer than three rows or ten cells are measured.
RoundReview review_round(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                         double to_m, double gap_m);

}  // namespace adit
