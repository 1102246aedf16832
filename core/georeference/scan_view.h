#pragma once
// What a scan shows in one direction, as the picture of a pinhole at the scanner.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/grey_picture.h"
#include "core/geometry/tile_source.h"

namespace adit {

/// Straight lines stay straight in it, so that what finds targets in a camera's picture finds them here. View frame:
/// x right, y down, z ahead; the principal point is the middle of the picture.
struct ScanView {
  Eigen::Matrix3d scan_from_view = Eigen::Matrix3d::Identity();
  double focal_px = 0.0;
  GreyPicture grey;        ///< to look at: intensity over what is usual at its range, between the points; 0 without any
  GreyPicture point_grey;  ///< to adjust to: of each pixel the mean of its own points
  std::vector<Eigen::Vector3f> points;  ///< of each pixel the mean of its points, scan frame; NaN where it has none

  double middle_px() const { return 0.5 * (grey.width - 1); }
  /// Unit, scan frame.
  Eigen::Vector3d direction(const Eigen::Vector2d& pixel) const;
  /// Nothing for what lies behind.
  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& in_scan) const;
  bool has_point(int u, int v) const { return points[grey.index(u, v)].x() == points[grey.index(u, v)].x(); }
  Eigen::Vector3d point(int u, int v) const { return points[grey.index(u, v)].cast<double>(); }
  /// The points of a pixel, which lie beside its middle, over a small target all to one side: scan and view have other
  /// rasters.
  std::optional<GreySample> sample(int u, int v) const;
};

/// Pixels for a unit of the plane z = 1 at which most pixels of a view hold a point: by how dense the scan is where it
/// is not densest; 2400 at most.
double view_focal_px(const TileSource& scan);

/// Rotations (scan_from_view) of 22 views about the scanner: eight along the horizon, six each up and down by 45
/// degrees, one up, one down. They overlap, so that what stands at the border of one lies whole in another.
std::vector<Eigen::Matrix3d> views_about();

/// One of these views of a scan whose frame begins at the scanner. Points nearer than 0.3 m are left out. The same
/// bytes on any number of threads.
ScanView scan_view(const TileSource& scan, const Eigen::Matrix3d& scan_from_view, double focal_px, Progress& progress);

}  // namespace adit
