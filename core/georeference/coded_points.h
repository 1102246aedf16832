#pragma once
// A coded target adjusted to the points of a scan on its plane.

#include <Eigen/Core>

#include <optional>

#include "core/georeference/detect_targets.h"
#include "core/georeference/scan_view.h"
#include "core/georeference/target_plane.h"

namespace adit {

struct CodedOnPlane {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< scan frame, on the plane
  double sigma_m = 0.0;                              ///< of the centre, its worst direction
  double diameter_m = 0.0;                           ///< of the ring of segments
};

/// Of a target that was found in the view's picture. Its pattern is moved, turned and scaled on the plane, with its
/// blur and brightness, until the grey of the points fits best where each point lies (Gauss-Newton, Huber's weights):
/// in the picture each stands in the middle of its pixel instead, and a target is a few pixels wide only. Nothing where
/// it does not end near the place that the picture gave.
std::optional<CodedOnPlane> coded_on_plane(const ScanView& view, const TargetPlane& plane, const DetectedTarget& found);

}  // namespace adit
