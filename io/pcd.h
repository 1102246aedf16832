#pragma once
// PCD, the files of the Point Cloud Library: ascii, binary and binary_compressed.

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

namespace adit::io {

/// True when a file begins as PCD files do.
bool is_pcd(std::string_view beginning);

/// x y z of any type; intensity, rgb or rgba and normals when present. A VIEWPOINT other than the identity becomes
/// file_pose. NaN in an organised cloud (HEIGHT over 1), or in all of x y z, is a place without a return. Errors as
/// stream_scans.
void stream_pcd(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header, with its counts checked against the file's size, and from a sample of a large file.
ScanFileSummary summarise_pcd(const std::filesystem::path& file, Progress& progress);

/// Variants ascii, binary (default), compressed. file_pose goes into VIEWPOINT. float coordinates where each is a
/// float32 exactly, else double. The compressed variant is gathered in memory; Error for a body of over 256 MiB.
std::unique_ptr<ScanWriter> make_pcd_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options);

}  // namespace adit::io
