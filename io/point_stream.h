#pragma once
// Points of a file, in double as they are read, on their way into a sink: what is not finite is judged, the rest goes
// out in blocks.

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// One point as a file gives it; attributes the file lacks stay as they are here.
struct FilePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< file coordinates [m]
  float intensity = 0.0F;
  std::array<std::uint8_t, 3> colour{};
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  GridPlace grid;
};

/// What a coordinate that is not a number says in this format.
enum class NanMeans {
  invalid,           ///< nothing good: an Error, unless points that are not finite are to be dropped
  no_return_if_all,  ///< x, y and z all NaN: the scanner saw nothing there
  no_return,         ///< any of them NaN: the scanner saw nothing there
};

/// Hands the points of one scan to a sink. Memory: one block.
class PointStream {
 public:
  /// Begins the scan in the sink.
  PointStream(ScanHeader header, const ReadOptions& options, NanMeans nan_means, ScanSink& sink);

  /// False: the sink does not want this scan; nothing may be added and end() does nothing.
  bool wanted() const { return wanted_; }

  /// Adds a point. place() -> std::string is asked only for the Error about a point that is not finite.
  template <typename Place>
  void add(const FilePoint& point, const Place& place) {
    if (!point.position.allFinite()) {
      if (!is_left_out(point.position)) refuse(point.position, place());
      return;
    }
    block_.positions.push_back(point.position);
    const Attributes& has = header_.attributes;
    if (has.intensity) block_.intensity.push_back(std::isfinite(point.intensity) ? point.intensity : 0.0F);
    if (has.colour) block_.colour.push_back(point.colour);
    if (has.normals)
      block_.normals.push_back(point.normal.allFinite() ? point.normal : Eigen::Vector3f(Eigen::Vector3f::Zero()));
    if (has.grid) block_.grid.push_back(point.grid);
    if (block_.size() == PointBlock::most_points) hand_out();
  }
  /// Counts a place of a raster without a point.
  void add_no_return() { ++no_returns_; }

  /// Ends the scan in the sink. Error when it held no points.
  void end();

 private:
  bool is_left_out(const Eigen::Vector3d& position);
  [[noreturn]] static void refuse(const Eigen::Vector3d& position, const std::string& where);
  void hand_out();

  ScanHeader header_;
  ReadOptions options_;
  NanMeans nan_means_;
  ScanSink& sink_;
  bool wanted_ = false;
  PointBlock block_;
  bool has_points_ = false;
  std::uint64_t no_returns_ = 0;
};

}  // namespace adit::io
