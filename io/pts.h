#pragma once
// PTS: a line with the number of points, then a line for each: x y z [intensity] [red green blue].

#include <filesystem>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// One scan for each count in the file (most have one), named after the file, then with -2, -3, ... Intensities keep
/// their scale. A count that disagrees with the lines below it is refused. Errors as stream_scans.
void stream_pts(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// x y z intensity, and red green blue where the scan has colours; no variants. Normals are left out.
void write_pts(const std::filesystem::path& file, const ScanData& scan, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
