#pragma once
// How even a surface is: the gap under a straightedge that is laid on it.

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"

namespace adit {

/// In one direction. Depths are those under the edge, square to the surface.
struct UndulationDirection {
  std::size_t places = 0;  ///< where the edge was laid: measured over its whole length
  double max_depth_m = 0.0;
  double chainage_m = 0.0;  ///< of the greatest depth
  double p_m = 0.0;
  double depth_95_m = 0.0;  ///< 95 % of the places are no deeper
  double over_limit = 0.0;  ///< share of the places whose depth over length of gap exceeds the limit
  double max_ratio = 0.0;   ///< greatest depth over length of gap; gaps under 0.2 m do not count
};

struct UndulationResult {
  double straightedge_m = 0.0;
  double limit_ratio = 0.0;    ///< permitted depth over length of gap; 0: none
  UndulationDirection along;   ///< the edge lies along the axis ...
  UndulationDirection around;  ///< ... or around the profile: bent like the design line, whose own curvature is none
};

/// The edge is laid at every cell, along the axis and around the profile, over stretches measured without a gap of more
/// than one cell; it touches the surface at its innermost points (the convex hull of the deviations under it), and the
/// gap under it is between two neighbouring touching points. A gap that reaches an end of the edge is none.
UndulationResult undulation(const DeviationMap& map, const DesignTunnel& design, double straightedge_m,
                            double limit_ratio);

}  // namespace adit
