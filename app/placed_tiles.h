#pragma once
// The placed scans as the profiling and surface steps take them.

#include <vector>

#include "app/job_state.h"
#include "core/profiling/profiling.h"

namespace adit::app {

/// Scans that the registration could place, with their poses, local frame.
std::vector<PlacedTiles> placed_tiles(const JobState& state);

}  // namespace adit::app
