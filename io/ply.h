#pragma once
// PLY: the vertices of ascii, little and big endian files.

#include <filesystem>
#include <string>
#include <string_view>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// True when a file begins as PLY files do.
bool is_ply(std::string_view beginning);

/// The element "vertex": x y z of any type; intensity (also scalar_intensity, reflectance), red green blue and nx ny nz
/// when present. Every other element and property is passed over. Errors as stream_scans.
void stream_ply(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header alone, with its counts checked against the file's size.
ScanFileSummary summarise_ply(const std::filesystem::path& file);

/// Variants ascii, little (default), big. float coordinates where the cloud's own are written, else double.
void write_ply(const std::filesystem::path& file, const ScanData& scan, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
