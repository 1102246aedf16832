#pragma once
// The errors of a simulated job.

#include "core/job/results.h"
#include "core/simulation/truth.h"

namespace adit::app {

/// Poses, and as far as they were computed volumes (reference line at offset 0) and section areas, against the truth.
TruthComparison compare_with_truth(const Results& results, const Truth& truth);

}  // namespace adit::app
