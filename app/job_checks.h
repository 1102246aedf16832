#pragma once
// What no file can know alone: whether the files of a job agree with each other. Before any long work begins.

#include "app/job_state.h"

namespace adit::app {

/// Throws Error for a chainage or a round outside the axis, a stretch without a profile, a design line that vanishes, a
/// target without its scan or control point, and for coordinates that cannot belong to this axis, or control that
/// cannot to the poses of the scans (another unit, east and north swapped).
void check_job(const JobState& state);

}  // namespace adit::app
