#pragma once
// The deviation map on disk, for later runs of the same job.

#include <filesystem>

#include "core/profiling/deviation_map.h"

namespace adit::io {

/// Written atomically with a checksum.
void write_deviation_map(const std::filesystem::path& file, const DeviationMap& map);

/// Error when the file is not a whole map of this version.
DeviationMap read_deviation_map(const std::filesystem::path& file);

}  // namespace adit::io
