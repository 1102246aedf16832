#pragma once
// The job's targets in its scans, and which control points they are.

#include <vector>

#include "app/job_state.h"

namespace adit::app {

/// Looks for what the job asks for in every scan whose frame begins at the scanner, and matches what it finds to
/// control: coded ones by their id, the others by distances. Findings say what was not found, fits control in more
/// than one way or fits none.
std::vector<FoundTarget> find_targets(const JobState& state, Findings& findings, Progress& progress);

}  // namespace adit::app
