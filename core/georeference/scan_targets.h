#pragma once
// Targets in a scan: spheres, black and white quarters, coded ones.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/tile_source.h"
#include "core/georeference/coded_pattern.h"

namespace adit {

enum class TargetKind { sphere, quarters, coded };

/// A target that was found. Scan frame.
struct ScanTarget {
  TargetKind kind = TargetKind::sphere;
  int code_id = 0;  ///< of coded ones
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double sigma_m = 0.0;  ///< of each coordinate
  double size_m = 0.0;   ///< diameter: of the sphere that fits best, of what shows quarters, of the ring of segments
  double size_sigma_m = 0.0;  ///< of spheres, whose size the points tell
  int pixels = 0;             ///< across, as dense as the scan sees it
};

struct ScanTargetOptions {
  double sphere_radius_m = 0.0;  ///< 0: none are looked for
  bool quarters = false;         ///< of boards of 6 cm and more
  bool coded = false;
  std::vector<TargetCode> codes;  ///< those that may hang there; empty: all
};

/// Looks at 22 views about the scanner (scan_view), in which straight lines stay straight: spheres by their shape, the
/// others in the intensity, their centres then on the plane of their points. In order of kind, id, and nearest first;
/// each once. The scan's frame must begin at the scanner. Without intensity, only spheres are found. Longest gap
/// between two checks for cancel: half a second.
std::vector<ScanTarget> find_scan_targets(const TileSource& scan, const ScanTargetOptions& options, Progress& progress);

}  // namespace adit
