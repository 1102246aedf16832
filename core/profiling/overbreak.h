#pragma once
// Over and under areas and first moments of one slice.

#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/outline.h"
#include "core/profiling/section.h"

namespace adit {

/// A design line as a polygon, made once per profile: its parallel curve, counter-clockwise in (x, z), arcs within 0.01
/// mm.
struct LinePolygon {
  DesignLine line;
  Polygon ring;
  AreaMoment design;  ///< positive
};
/// Throws Error when the offset leaves nothing or cuts the line into several parts.
LinePolygon line_polygon(const Profile& profile, const DesignLine& line);

/// The two boolean differences between the as-built outline and a design line (docs/accuracy.md, areas).
struct SliceAmounts {
  AreaMoment area;   ///< inside the as-built outline
  AreaMoment over;   ///< inside the outline, outside the line
  AreaMoment under;  ///< outside the outline, inside the line
};
SliceAmounts slice_amounts(const std::vector<OutlinePoint>& outline, const LinePolygon& line);

/// All numbers of one outline against one line.
SectionAreas section_areas(const Outline& outline, const ProfileStretch& stretch, double step_q_m,
                           const LinePolygon& line);

}  // namespace adit
