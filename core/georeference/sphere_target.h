#pragma once
// Spheres of a known radius in a scan.

#include <Eigen/Core>

#include <vector>

#include "core/foundation/progress.h"
#include "core/georeference/scan_view.h"

namespace adit {

struct FoundSphere {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< scan frame
  double sigma_m = 0.0;                              ///< of the centre, its worst direction
  double rms_m = 0.0;                                ///< of the points from the sphere
  double free_radius_m = 0.0;                        ///< of the sphere that fits best, were its radius not known
  double free_radius_sigma_m = 0.0;
  int pixels = 0;  ///< of the view that lie on it
};

/// Spheres that stand free before what is behind them, but for what they stand on. Where the view shows a cap of that
/// radius, the sphere is adjusted to the points that face the scanner (Huber's weights); it counts where most of what
/// should lie on it does, little else lies about it, and the radius that fits best is that one within 5 % or three of
/// its sigmas. Seen with fewer than 40 pixels, none is looked for.
std::vector<FoundSphere> find_spheres(const ScanView& view, double radius_m, Progress& progress);

}  // namespace adit
