#pragma once
// Where a scan stood before registration, as far as anything says.

#include <optional>

#include "app/job_state.h"

namespace adit::app {

/// local-from-scan by the job's word, the file's own, or coordinates that are the site's already.
std::optional<Pose> local_from_scan_guess(const JobState& state, std::size_t scan);

}  // namespace adit::app
