#pragma once
// Points as text in columns: XYZ, TXT, CSV.

#include <filesystem>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// Blanks, tabs, commas or semicolons between the columns; lines that begin with # or // are comments. Column names
/// (x y z or easting northing elevation; intensity; r g b; nx ny nz; quoted or not) are taken from the first line, or
/// from a comment before the first point; without names the first three columns are x y z and the others are not read.
/// All lines have the same number of columns. Errors as stream_scans.
void stream_xyz(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// With a line of column names; commas between the columns of a .csv file, blanks elsewhere; no variants.
void write_xyz(const std::filesystem::path& file, const ScanData& scan, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
