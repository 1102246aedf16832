#pragma once
// A scan as a writer sees it: checked, and moved where the format cannot hold the pose.

#include <Eigen/Core>

#include <filesystem>
#include <string>

#include "io/scan_formats.h"

namespace adit::io {

/// Whether file_pose is applied to the points (formats without a pose) or written beside them.
enum class PoseGoes { into_points, beside_points };

/// Read-only view of a scan on its way out; the scan must outlive it.
class OutgoingScan {
 public:
  /// Error with `file` for a scan without points, with points that are not finite, or with attributes of another
  /// length.
  OutgoingScan(const ScanData& scan, PoseGoes pose_goes, const std::filesystem::path& file);

  std::size_t size() const { return scan_.cloud.size(); }
  const PointCloud& cloud() const { return scan_.cloud; }
  /// Coordinates to write [m].
  Eigen::Vector3d position(std::size_t i) const {
    const Eigen::Vector3d in_file = scan_.cloud.points[i].cast<double>() + scan_.offset;
    return moved_ ? Eigen::Vector3d(pose_ * in_file) : in_file;
  }
  Eigen::Vector3f normal(std::size_t i) const {
    return moved_ ? Eigen::Vector3f(pose_.linear().cast<float>() * scan_.cloud.normals[i]) : scan_.cloud.normals[i];
  }
  /// True when the coordinates are the cloud's own float32.
  bool is_float32() const { return !moved_ && scan_.offset.isZero(0.0); }
  /// Box of the coordinates to write.
  BoundingBox box() const;

 private:
  const ScanData& scan_;
  bool moved_ = false;
  Pose pose_ = Pose::Identity();
};

/// How intensities fit into a format that holds 0 .. most: written = (value - zero) * factor.
struct IntensityRange {
  double zero = 0.0;
  double factor = 1.0;
  double operator()(float value) const { return (static_cast<double>(value) - zero) * factor; }
};
/// Values that fit are kept; values within 0 .. 1 are multiplied by `most` (where most > 1); all others are stretched
/// so that the least becomes 0 and the greatest `most`. whole: the format holds whole numbers, fractions do not fit.
IntensityRange intensity_range(const PointCloud& cloud, double most, bool whole);

/// Error unless the variant is one of `known` ("" always is).
void expect_variant(const WriteOptions& options, const std::vector<std::string>& known,
                    const std::filesystem::path& file);

}  // namespace adit::io
