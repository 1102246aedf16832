#pragma once
// Over- and underbreak areas along the chainage with the excess volume added up.

#include <vector>

#include "core/job/job.h"
#include "core/profiling/section.h"
#include "render/canvas.h"

namespace adit::render {

/// Overbreak area [m2] above zero, underbreak area below, a bar for each section; a line adds up the excess (over minus
/// under) by average end areas [m3], right-hand axis. Boundaries of rounds with their numbers.
void draw_volume_chart(Canvas& canvas, const Rect& rect, const std::vector<Section>& sections,
                       const std::vector<JobRound>& rounds);

/// The excess volume [m3] up to each section by average end areas of the reference line; 0 at the first.
std::vector<double> accumulated_excess_m3(const std::vector<Section>& sections);

}  // namespace adit::render
