#pragma once
// Pictures of a registration, on demand: `adit register --figures`.

#include <filesystem>
#include <vector>

#include "app/job_state.h"
#include "core/foundation/progress.h"

namespace adit::app {

/// Writes into out/figures, in place of the same pictures of an earlier run (nothing else there is touched):
/// ndt-1-NAME.png for each placed scan (its normal distributions in cells of 1 m, from above, site axes) and
/// overlap-1-NAME-NAME.png for each used pair, the greatest rms first. Gives the files.
std::vector<std::filesystem::path> write_registration_figures(const JobState& state, Progress& progress);

}  // namespace adit::app
