#pragma once
// Rings against the axis: their deviations along the chainage, and one ring with its residuals.

#include <vector>

#include "core/profiling/rings.h"
#include "render/canvas.h"

namespace adit::render {

/// Horizontal and vertical deviations over the chainage [mm], with two sigmas where they are known.
void draw_ring_deviations(Canvas& canvas, const Rect& rect, const std::vector<RingResult>& rings);

/// One ring looking up-chainage: the circle, and at each point its residual, enlarged so that `largest_m` is a fifth of
/// the radius on the paper. Outside red, inside blue.
void draw_ring(Canvas& canvas, const Rect& rect, const RingResult& ring, double largest_m);

}  // namespace adit::render
