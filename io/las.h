#pragma once
// LAS 1.0 to 1.4, uncompressed.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/foundation/progress.h"
#include "io/las_header.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// True when a file begins as LAS (and LAZ) files do.
bool is_las(std::string_view beginning);

/// Point formats 0 to 10: coordinates, intensity (0 .. 65535) and colour. Compressed points are refused by name, and so
/// is a file that holds fewer or more points than its header says. Errors as stream_scans.
void stream_las(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// What a header says of the points, LAS and LAZ alike.
Attributes las_attributes(const LasHeader& header);
/// All that a header says, without a look at the points. format: "LAS" or "LAZ".
ScanFileSummary las_summary(const InputFile& file, const LasHeader& header, const std::string& format);

/// From the header, with its counts checked against the file's size, and from a sample of a large file.
ScanFileSummary summarise_las(const std::filesystem::path& file, Progress& progress);

/// LAS 1.4, point format 6, or 7 with colour. Coordinates are whole tenths of a millimetre about a whole-metre offset
/// (a coarser step only beyond 200 km). Intensities as intensity_range() says; normals are left out.
std::unique_ptr<ScanWriter> make_las_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
