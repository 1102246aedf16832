#pragma once
// PTX: scans on their grids, each with the transform from the scanner's frame to the site.

#include <filesystem>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// All scans of a file, named after it, then with -2, -3, ..., each with its grid. The points stay in the scanner's
/// frame; the transform becomes file_pose unless it is the identity, and is refused when it is not rigid to 1e-3. "0 0
/// 0" is a place without a return. Intensities 0 .. 1 are kept. Errors as stream_scans.
void stream_ptx(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// Each scan as a grid of one column; intensities as intensity_range() says, 0.5 where the scan has none; no variants.
/// Normals are left out.
void write_ptx(const std::filesystem::path& file, const std::vector<ScanData>& scans, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
