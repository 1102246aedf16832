#pragma once
// How well pairs of scans fit, as bars.

#include <vector>

#include "core/registration/registration.h"
#include "render/canvas.h"

namespace adit::render {

/// A bar for each pair: point-to-plane rms [mm], a tick at the median; grey for pairs that were not used. At most as
/// many pairs as the rectangle has room for (3.4 mm each), the worst first, and a line that says how many are missing.
void draw_pair_bars(Canvas& canvas, const Rect& rect, std::vector<PairResult> pairs);

/// Height [mm] for all pairs.
double pair_bars_height(std::size_t pairs);

}  // namespace adit::render
