#pragma once
// Files that a JSON file names.

#include <filesystem>
#include <string>

#include "io/json_place.h"

namespace adit::io {

/// The name at `place`, of a file that is there, relative to `folder`. Throws Error with the key otherwise, and for a
/// folder.
std::string existing_file(const JsonPlace& place, const std::filesystem::path& folder);

}  // namespace adit::io
