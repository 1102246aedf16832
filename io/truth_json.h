#pragma once
// truth.json: what is true of a simulated job.

#include <filesystem>
#include <string>

#include "core/simulation/truth.h"

namespace adit::io {

std::string truth_text(const Truth& truth);

/// Throws Error with the key for anything that is not what truth_text wrote.
Truth read_truth(const std::filesystem::path& file);

}  // namespace adit::io
