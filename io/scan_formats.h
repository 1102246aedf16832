#pragma once
// The table of scan formats: ending, signature, reader, writer; and the doors everybody uses.

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/bounding_box.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/pose.h"
#include "io/scan_stream.h"
#include "io/scan_writer.h"

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

/// About how dense the points lie, from a sample. Two digits are all it is good for.
struct PointDensity {
  double points_per_m2 = 0.0;        ///< of the surface that was seen
  std::optional<double> distance_m;  ///< at this distance from the file's origin; else the median of all points
  double spacing_m() const;
};

/// What a header says of a scan and a quick look shows.
struct ScanSummary {
  std::string name;
  std::uint64_t points = 0;  ///< as the header says, places without a return among them
  bool points_estimated = false;
  std::optional<Pose> pose;
  BoundingBox box;                      ///< file coordinates; empty when a quick look cannot tell
  std::string box_from;                 ///< "header", "sample" or "all points"; empty without a box
  std::vector<std::string> attributes;  ///< "intensity", "colour", "normals", ...
  std::uint64_t columns = 0;            ///< of the raster; 0 without one
  std::uint64_t rows = 0;
  std::uint64_t sampled_points = 0;         ///< points that were looked at
  std::optional<std::uint64_t> no_returns;  ///< places without a return, where all points were looked at
  std::optional<PointDensity> density;
};

/// A thing a header says beyond the scans, for people: {"software", "..."}.
struct HeaderFact {
  std::string name;
  std::string text;
};

struct ScanFileSummary {
  std::string format;  ///< "PLY binary little endian", "LAS 1.4 point format 6", ...
  std::vector<HeaderFact> header;
  std::vector<ScanSummary> scans;
};

/// How to read.
struct ReadOptions {
  bool drop_invalid = false;    ///< leave out points that are not finite instead of refusing the file
  bool positions_only = false;  ///< leave out attributes where unpacking them takes time of its own (LAZ)
};

/// True when the ending or the first bytes name a scan format this build knows.
bool is_scan_file(const std::filesystem::path& file);

/// Streams all scans of a file (most formats hold one) into a sink; memory is bounded by a block of points. Throws
/// Error with file and place (record, line or byte) for anything broken: truncated, counts that the file cannot hold,
/// text where a number belongs, NaN or infinite coordinates, no points at all.
void stream_scans(const std::filesystem::path& file, const ReadOptions& options, ScanSink& sink, Progress& progress);

/// The same into memory, for files known to be small. Errors as stream_scans.
std::vector<ScanData> read_scans(const std::filesystem::path& file, const ReadOptions& options, Progress& progress);

/// What a file holds and about where its points lie: from the header, and from a sample of the points where the file
/// is larger than 8 MiB. PTX and PTS are read through for their line ends alone, which tell where the next scan begins.
ScanFileSummary summarise_scan_file(const std::filesystem::path& file, Progress& progress);

/// What the files of a format can hold.
struct FormatHolds {
  PoseGoes pose_goes = PoseGoes::into_points;
  bool several_scans = false;
  bool normals = false;
  bool raster = false;
  double most_intensity = 0.0;  ///< intensities are stretched to 0 .. this; 0: they stay as they are
};
/// By the ending of a file to be written.
FormatHolds format_holds(const std::filesystem::path& file);

/// How to write.
struct WriteOptions {
  std::string variant;  ///< "" is the format's default; PLY: ascii, little, big; PCD: ascii, binary, compressed; E57:
                        ///< scaled, double
};

/// Error unless scans can be written to this file: its ending, the variant, the folder.
void expect_writable(const std::filesystem::path& file, const WriteOptions& options);

/// The writer of a new file, by its ending (.ply .pcd .e57 .laz .las .pts .ptx .xyz .csv). Several scans only where the
/// format can (E57, PTX); elsewhere Error. Formats without a pose get the points moved by file_pose where there is one.
/// What is handed in must be what the facts were taken from; Error otherwise.
std::unique_ptr<ScanWriter> make_scan_writer(const std::filesystem::path& file, std::vector<ScanFacts> scans,
                                             const WriteOptions& options);

/// Writes scans in memory, atomically. As make_scan_writer().
void write_scans(const std::filesystem::path& file, const std::vector<ScanData>& scans, const WriteOptions& options,
                 Progress& progress);

/// Endings that can be read and written, for help texts.
std::vector<std::string> readable_endings();
std::vector<std::string> writable_endings();
/// Endings that Adit knows but this build does not, for want of a library.
std::vector<std::string> endings_not_built_in();

}  // namespace adit::io
