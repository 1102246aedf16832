#pragma once
// PCD, the files of the Point Cloud Library: ascii, binary and binary_compressed.

#include <filesystem>
#include <string_view>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// True when a file begins as PCD files do.
bool is_pcd(std::string_view beginning);

/// x y z of any type; intensity, rgb or rgba and normals when present. A VIEWPOINT other than the identity becomes
/// file_pose. NaN in an organised cloud (HEIGHT over 1), or in all of x y z, is a place without a return. Errors as
/// stream_scans.
void stream_pcd(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// From the header alone, with its counts checked against the file's size.
ScanFileSummary summarise_pcd(const std::filesystem::path& file);

/// Variants ascii, binary (default), compressed. file_pose goes into VIEWPOINT. float coordinates where the cloud has
/// no offset, else double.
void write_pcd(const std::filesystem::path& file, const ScanData& scan, const WriteOptions& options,
               Progress& progress);

}  // namespace adit::io
