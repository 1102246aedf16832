#pragma once
// Faces, layers, changes and evenness as members of results.json.

#include <nlohmann/json.hpp>

#include "core/job/results.h"

namespace adit::io {

/// Adds "face", "before" and "undulation", each only where the job asks for it.
void add_comparison(const CompareResult& result, nlohmann::ordered_json& root);

}  // namespace adit::io
