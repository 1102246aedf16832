#pragma once
// Sets of tolerances as JSON files, and the library of such files.

#include <filesystem>
#include <string>

#include "core/design/tolerances.h"

namespace adit::io {

/// { "name", "source", "verified_by", "rows": [ { "rock_class", "sector", "mean_overbreak_m", "max_overbreak_m",
/// "max_underbreak_m", "max_underbreak_area_m2" } ] }. Every row needs a limit. Throws Error with file and key for
/// anything else, and for two rows of one class and sector.
ToleranceSet read_tolerances(const std::filesystem::path& file);

/// A set of the library by its name. Throws Error listing the names.
ToleranceSet library_tolerances(const std::string& name);

}  // namespace adit::io
