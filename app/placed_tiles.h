#pragma once
// The placed scans as the profiling and surface steps take them.

#include <vector>

#include "app/job_state.h"
#include "core/profiling/profiling.h"

namespace adit::app {

/// Scans that the registration could place, with their poses, local frame.
std::vector<PlacedTiles> placed_tiles(const JobState& state);

/// Whether the scanner stood where the file's coordinates begin: none was taken off them, and the points stand about
/// there. An export in coordinates of a mine's grid has its own origin far off.
bool scanner_at_origin(const io::PointStore& store);

}  // namespace adit::app
