#pragma once
// Points as text in columns: XYZ, TXT, CSV.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// Blanks, tabs, commas or semicolons between the columns; lines that begin with # or // are comments. Column names
/// (x y z or easting northing elevation; intensity; r g b; nx ny nz; quoted or not) are taken from the first line, or
/// from a comment before the first point; without names the first three columns are x y z and the others are not read.
/// All lines have the same number of columns. Errors as stream_scans.
void stream_xyz(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the column names; lines are counted up to 64 MiB, beyond that their number is estimated from a sample.
ScanFileSummary summarise_xyz(const std::filesystem::path& file, Progress& progress);

/// With a line of column names; commas between the columns of a .csv file, blanks elsewhere.
std::unique_ptr<ScanWriter> make_xyz_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
