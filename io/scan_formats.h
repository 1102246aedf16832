#pragma once
// The table of scan formats: ending, signature, reader, writer; and the doors everybody uses.

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/bounding_box.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/pose.h"
#include "io/scan_stream.h"

namespace adit::io {

/// One scan in memory. File coordinates = cloud point + offset (offset is zero unless the coordinates are too
/// large for float32: then a whole-metre shift). file_pose is what the file itself says of the scanner (PTX, PCD
/// viewpoint), site-from-file coordinates.
struct ScanData {
  std::string name;
  PointCloud cloud;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::optional<Pose> file_pose;
  std::uint64_t no_returns = 0;  ///< places of a grid without a point (NaN in organised PCD, 0 0 0 in PTX), left out
};

/// What a header says and a quick look confirms.
struct ScanSummary {
  std::string name;
  std::uint64_t points = 0;
  std::optional<Pose> pose;
  BoundingBox box;                      ///< file coordinates
  std::vector<std::string> attributes;  ///< "intensity", "colour", "normals", ...
};
struct ScanFileSummary {
  std::string format;  ///< "PLY binary little endian", "LAS 1.4 point format 6", ...
  std::vector<ScanSummary> scans;
};

/// How to read.
struct ReadOptions {
  bool drop_invalid = false;  ///< leave out points that are not finite instead of refusing the file
};

/// True when the ending or the first bytes name a scan format this build knows.
bool is_scan_file(const std::filesystem::path& file);

/// Streams all scans of a file (most formats hold one) into a sink; memory is bounded by a block of points. Throws
/// Error with file and place (record, line or byte) for anything broken: truncated, counts that the file cannot hold,
/// text where a number belongs, NaN or infinite coordinates, no points at all.
void stream_scans(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// The same into memory, for files known to be small. Errors as stream_scans.
std::vector<ScanData> read_scans(const std::filesystem::path& file, const ReadOptions& options, Progress& progress);

/// What a file holds and where its points lie: from the header alone where it says so (LAS), else read through.
ScanFileSummary summarise_scan_file(const std::filesystem::path& file, Progress& progress);

/// Writes by ending (.ply .pcd .las .pts .ptx .xyz .csv), atomically. Several scans only where the format can (PTX);
/// elsewhere Error. Formats without a pose get the points moved by file_pose where there is one.
struct WriteOptions {
  std::string variant;  ///< "" is the format's default; PLY: ascii, little, big; PCD: ascii, binary, compressed
};
void write_scans(const std::filesystem::path& file, const std::vector<ScanData>& scans, const WriteOptions& options,
                 Progress& progress);

/// Endings that can be read and written, for help texts.
std::vector<std::string> readable_endings();
std::vector<std::string> writable_endings();

}  // namespace adit::io
