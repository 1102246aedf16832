#pragma once
// LAZ: LAS with its points compressed by LASzip.

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// True when a file begins as LAZ files do; 105 bytes are needed.
bool is_laz(std::string_view beginning);

/// False when this build lacks LASzip: the functions below refuse every file by name.
bool laz_is_built_in();

/// Point formats 0 to 10 of LAS 1.0 to 1.4: coordinates, intensity (0 .. 65535) and colour. Points of LAS 1.4 that hide
/// in records of LAS 1.2 ("compatibility mode") have the same of these in either reading. Errors as stream_scans.
void stream_laz(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header alone, with the chunks of points checked against it.
ScanFileSummary summarise_laz(const std::filesystem::path& file, Progress& progress);

/// A file of one scan, LAS 1.4 point format 6, or 7 with colour; no variants. Coordinates, intensities and colours as
/// make_las_writer(); a pose and normals are left out. The same points make the same bytes.
std::unique_ptr<ScanWriter> make_laz_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
