#pragma once
// LAS 1.0 to 1.4, uncompressed.

#include <filesystem>
#include <string_view>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// True when a file begins as LAS (and LAZ) files do.
bool is_las(std::string_view beginning);

/// Point formats 0 to 10: coordinates, intensity (0 .. 65535) and colour. Compressed points are refused by name, and so
/// is a file that holds fewer or more points than its header says. Errors as stream_scans.
void stream_las(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header alone, with its counts checked against the file's size.
ScanFileSummary summarise_las(const std::filesystem::path& file);

/// LAS 1.4, point format 6, or 7 with colour; no variants. Coordinates are whole tenths of a millimetre about a
/// whole-metre offset (a coarser step only beyond 200 km). Intensities as intensity_range() says; normals are left out.
void write_las(const std::filesystem::path& file, const ScanData& scan, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
