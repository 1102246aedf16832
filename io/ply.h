#pragma once
// PLY: the vertices of ascii, little and big endian files.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// True when a file begins as PLY files do.
bool is_ply(std::string_view beginning);

/// The element "vertex": x y z of any type; intensity (also scalar_intensity, reflectance), red green blue and nx ny nz
/// when present. Every other element and property is passed over. Errors as stream_scans.
void stream_ply(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header, with its counts checked against the file's size, and from a sample of a large file.
ScanFileSummary summarise_ply(const std::filesystem::path& file, Progress& progress);

/// Variants ascii, little (default), big. float coordinates where each is a float32 exactly, else double.
std::unique_ptr<ScanWriter> make_ply_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
