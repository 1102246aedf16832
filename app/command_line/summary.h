#pragma once
// Results in a few lines for a terminal.

#include <string>

#include "app/job_state.h"

namespace adit::app {

std::string summary_text(const JobState& state);

}  // namespace adit::app
