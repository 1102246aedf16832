#pragma once
// A look at the first points of a file whose points cannot be jumped to.

#include <filesystem>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

using StreamScans = void (*)(const std::filesystem::path&, const ReadOptions&, ScanSink&, Progress&);

/// Completes a summary with the density of each large scan that was not sampled, from its first 200,000 points. They
/// are a patch of the scan, or strewn over all of it; which, their first half tells: on a patch of the scan it is as
/// dense as both halves, of a strewn scan half as dense. No density where neither is plain.
void complete_from_beginnings(ScanFileSummary& summary, const std::filesystem::path& file, StreamScans stream,
                              Progress& progress);

}  // namespace adit::io
