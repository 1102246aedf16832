#pragma once
// Sections through the overlaps of a job's pairs, for the report and for pictures.

#include <vector>

#include "app/job_state.h"
#include "core/foundation/progress.h"
#include "render/overlap_drawing.h"

namespace adit::app {

/// Of the used pairs, at most `most`, those with the greatest rms first.
std::vector<render::PairSection> pair_sections(const JobState& state, std::size_t most, const Progress& progress);

}  // namespace adit::app
