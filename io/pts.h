#pragma once
// PTS: a line with the number of points, then a line for each: x y z [intensity] [red green blue].

#include <filesystem>
#include <memory>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// One scan for each count in the file (most have one), named after the file, then with -2, -3, ... Intensities keep
/// their scale. A count that disagrees with the lines below it is refused. Errors as stream_scans.
void stream_pts(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the counts, with the lines below them counted but not read, and from a sample of a large file.
ScanFileSummary summarise_pts(const std::filesystem::path& file, Progress& progress);

/// x y z intensity, and red green blue where the scan has colours. Normals are left out.
std::unique_ptr<ScanWriter> make_pts_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
