#pragma once
// Where the job's cameras stood, by the pictures of its scans.

#include <vector>

#include "app/job_state.h"

namespace adit::app {

/// All pictures of all scans, in the job's order; a finding names each that says nothing, and each target that
/// contradicts the others. Throws Error for a picture that cannot be read or is not of its camera's size.
std::vector<LocatedPicture> locate_pictures(const JobState& state, Findings& findings, Progress& progress);

/// Takes up the adjustment's pictures (those with a sight, in order) among all of them.
std::vector<PictureResult> with_adjusted(std::vector<LocatedPicture> located,
                                         const std::vector<PictureResult>& adjusted);

}  // namespace adit::app
