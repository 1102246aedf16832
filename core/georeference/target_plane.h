#pragma once
// The plane of a flat target in a view of a scan, and where a pixel lies on it.

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <optional>

#include "core/georeference/scan_view.h"

namespace adit {

/// Scan frame.
struct TargetPlane {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, towards the scanner
  double rms_m = 0.0;
  int points = 0;

  /// Where the line of sight of a direction meets it.
  Eigen::Vector3d met_by(const Eigen::Vector3d& direction) const {
    return direction * (normal.dot(middle) / normal.dot(direction));
  }
  /// How well it is known there along the line of sight, one sigma. `direction`: unit.
  double sigma_along_m(const Eigen::Vector3d& direction) const {
    return rms_m / std::sqrt(static_cast<double>(points)) / std::abs(normal.dot(direction));
  }
};

/// Least squares over the view's points at pixels within reach_px of a centre that are `inside`; those farther off than
/// three sigmas are left out. Nothing where there are fewer than 12, or where it is seen from more than 80 degrees
/// aside.
std::optional<TargetPlane> target_plane(const ScanView& view, const Eigen::Vector2d& center, double reach_px,
                                        const std::function<bool(const Eigen::Vector2d&)>& inside);

/// A place on the plane with its covariance, from that of the pixel and the plane's own.
struct PlanePlace {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< its worst direction
};
PlanePlace place_on_plane(const ScanView& view, const TargetPlane& plane, const Eigen::Vector2d& pixel,
                          const Eigen::Matrix2d& covariance_px2);

}  // namespace adit
