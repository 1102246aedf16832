#pragma once
// Points of a file, in double as they are read, become one ScanData: what is not finite is judged, and coordinates too
// large for float32 are moved by whole metres.

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "io/scan_formats.h"

namespace adit::io {

/// One point as a file gives it; attributes the file lacks stay as they are here.
struct FilePoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< file coordinates [m]
  float intensity = 0.0F;
  std::array<std::uint8_t, 3> colour{};
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

/// Which attributes every point of a file has.
struct Attributes {
  bool intensity = false;
  bool colour = false;
  bool normals = false;
};
/// Their names as ScanSummary lists them.
std::vector<std::string> attribute_names(const Attributes& attributes);

/// What a coordinate that is not a number says in this format.
enum class NanMeans {
  invalid,           ///< nothing good: an Error, unless points that are not finite are to be dropped
  no_return_if_all,  ///< x, y and z all NaN: the scanner saw nothing there
  no_return,         ///< any of them NaN: the scanner saw nothing there
};

/// Collects points of one scan. Memory while reading: 24 bytes a point and its attributes.
class CloudBuilder {
 public:
  CloudBuilder(Attributes attributes, const ReadOptions& options, NanMeans nan_means = NanMeans::invalid);

  /// Takes the memory for the attributes of `count` points, once the file's size has confirmed the count.
  void expect(std::uint64_t count);

  /// Adds a point. place() -> std::string is asked only for the Error about a point that is not finite.
  template <typename Place>
  void add(const FilePoint& point, const Place& place) {
    if (!point.position.allFinite()) {
      if (!is_left_out(point.position)) refuse(point.position, place());
      return;
    }
    chunk_.push_back(point.position);
    if (attributes_.intensity) cloud_.intensity.push_back(std::isfinite(point.intensity) ? point.intensity : 0.0F);
    if (attributes_.colour) cloud_.colour.push_back(point.colour);
    if (attributes_.normals)
      cloud_.normals.push_back(point.normal.allFinite() ? point.normal : Eigen::Vector3f(Eigen::Vector3f::Zero()));
    if (chunk_.size() == chunk_points) close_chunk();
  }
  /// Counts a place of a grid without a point.
  void add_no_return() { ++no_returns_; }

  /// The scan; the builder is empty afterwards. Error with `where` when there are no points, or when they lie too far
  /// apart (or from zero) for a scan: float32 would round by more than 2 mm.
  ScanData finished(const std::string& name, const std::string& where, const Progress& progress);

 private:
  static constexpr std::size_t chunk_points = 65536;

  bool is_left_out(const Eigen::Vector3d& position);
  [[noreturn]] static void refuse(const Eigen::Vector3d& position, const std::string& where);
  void close_chunk();
  Eigen::Vector3d chosen_offset(const std::string& where) const;

  Attributes attributes_;
  ReadOptions options_;
  NanMeans nan_means_;
  std::vector<std::vector<Eigen::Vector3d>> chunks_;
  std::vector<Eigen::Vector3d> chunk_;
  BoundingBox box_;
  double largest_loss_m_ = 0.0;  ///< by float32 without an offset
  std::size_t count_ = 0;
  std::uint64_t no_returns_ = 0;
  PointCloud cloud_;
};

}  // namespace adit::io
