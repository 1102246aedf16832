#pragma once
// PTX: scans on their grids, each with the transform from the scanner's frame to the site.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// All scans of a file, named after it, then with -2, -3, ..., each with its grid. The points stay in the scanner's
/// frame; the transform becomes file_pose unless it is the identity, and is refused when it is not rigid to 1e-3. "0 0
/// 0" is a place without a return. Intensities 0 .. 1 are kept. Errors as stream_scans.
void stream_ptx(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the headers of all scans, with the lines between them counted but not read, and from a sample of a large file.
ScanFileSummary summarise_ptx(const std::filesystem::path& file, Progress& progress);

/// Scans with a raster whose points come column by column are written on it, "0 0 0 0.5" where there was no return; all
/// others as one column. Intensities as intensity_range() says, 0.5 where the scan has none. Normals are left out.
std::unique_ptr<ScanWriter> make_ptx_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
