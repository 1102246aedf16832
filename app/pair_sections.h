#pragma once
// Sections through the overlaps of a job's pairs, for the report and for pictures.

#include <vector>

#include "app/job_state.h"
#include "core/foundation/progress.h"
#include "render/overlap_drawing.h"

namespace adit::app {

/// Of the pairs between placed scans, at most `most`: the used ones as they stand, those with the greatest rms first,
/// then those that were not used, the source where the pair alone would lay it.
std::vector<render::PairSection> pair_sections(const JobState& state, std::size_t most, const Progress& progress);

}  // namespace adit::app
