#pragma once
// Control points, targets seen in scans, and the rigid fit between them.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"

namespace adit {

/// A surveyed point: site coordinates [m].
struct ControlPoint {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// A target found in a scan: coordinates in the scan's frame [m].
struct TargetObservation {
  std::string scan;
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< of each coordinate, beside that of all targets
};

/// What is left of a target after the adjustment: observed minus control, site axes [m].
struct ControlResidual {
  std::string scan;
  std::string id;
  Eigen::Vector3d residual_m = Eigen::Vector3d::Zero();
  bool used = true;  ///< false when the adjustment found it wrong and left it out
  /// How much of an error of this target the others would show, mean of the three axes (Baarda 1968): 0 nothing checks
  /// it, 1 the rest knows its place without it. And the residual in the sigmas that residuals there
  /// have: the greatest of its axes, or eight ninths of its length, whichever is more. Both 0 for targets that are not
  /// used.
  double redundancy = 0.0;
  double normalised = 0.0;
};

/// A normalised residual beyond this is a blunder: by chance one in 5,000 of axes, and one in 7,000 of lengths.
inline constexpr double wrong_normalised = 4.0;

/// Rigid transform (least squares, Arun et al. 1987 / Umeyama without scale) target_from_source over pairs of points.
/// Empty with fewer than three points or when they lie on one line (1 cm).
std::optional<Pose> fit_rigid(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target);

}  // namespace adit
