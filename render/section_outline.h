#pragma once
// What a section drawing shows, as plain geometry: the outline in runs, and the areas over and under a line.

#include <vector>

#include "core/geometry/polygon.h"
#include "core/profiling/section.h"

namespace adit::render {

/// A stretch of the outline seen in one way.
struct OutlineRun {
  CellKind kind = CellKind::measured;
  Polygon points;  ///< an open polyline; the whole closed ring (first point repeated) when all is of one kind
};

/// The outline cut where the kind changes. An edge is as good as the weaker of its ends.
std::vector<OutlineRun> outline_runs(const std::vector<OutlinePoint>& outline);

/// Rings of rock outside the line (over) and of rock left inside it (under).
struct OverUnder {
  std::vector<Polygon> over;
  std::vector<Polygon> under;
};
/// Where nobody looked the outline follows the line (at offset_m from the profile), so that nothing unseen counts.
OverUnder over_under(const std::vector<OutlinePoint>& outline, const Polygon& line, double offset_m);

/// The points of an open line that are needed to stay within the tolerance [same unit] of it (Douglas and Peucker
/// 1973).
Polygon thinned(const Polygon& points, double tolerance);

/// The outline's point nearest to p along the line (p runs around the closed line); nullptr for an empty outline.
const OutlinePoint* outline_at(const std::vector<OutlinePoint>& outline, double p_m);

}  // namespace adit::render
