#pragma once
// E57 (ASTM E2807): several scans with their poses in one file.

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// True when a file begins as E57 files do.
bool is_e57(std::string_view beginning);

/// False when this build lacks libE57Format: the functions below refuse every file by name.
bool e57_is_built_in();

/// All scans of a file, each in its own frame with its pose: cartesian or spherical coordinates, intensity as the file
/// has it, colour stretched from its limits to 8 bits, normals, row and column. Points that the file calls invalid are
/// places without a return. The file's checksums are checked. Errors as stream_scans; also for a pose that is no rigid
/// one, and for a number of records that the file cannot hold.
void stream_e57(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the XML part alone; no point is read.
ScanFileSummary summarise_e57(const std::filesystem::path& file, Progress& progress);

/// A file of all scans. Variants: scaled (default; whole tenths of a millimetre, doubles only where a scan spans more
/// than 400 km) and double. Intensities and row and column as they are. The same points make the same bytes:
/// identifiers are hashes of what the file holds, and no date is written.
std::unique_ptr<ScanWriter> make_e57_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
