#pragma once
// A scan in memory as a stream, for writers.

#include <filesystem>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// Hands the points of a scan to a sink. `file` is what Errors name: for no points, points that are not finite and
/// attributes of another length.
void stream_from_memory(const ScanData& scan, const std::filesystem::path& file, ScanSink& sink,
                        const Progress& progress);

}  // namespace adit::io
