#pragma once
// What is true of a simulated job: areas and volumes by dense integration of the analytic surface.

#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/profiling/volume.h"
#include "core/simulation/rock_tunnel.h"

namespace adit {

/// Exact areas of the plane at one chainage against the profile (offset 0), and their first moments about the axis.
struct TrueSection {
  double chainage_m = 0.0;
  double design_area_m2 = 0.0;
  double area_m2 = 0.0;
  double overbreak_m2 = 0.0;
  double underbreak_m2 = 0.0;
  double overbreak_moment_m3 = 0.0;
  double underbreak_moment_m3 = 0.0;
};

struct Truth {
  std::vector<std::string> scan_names;
  std::vector<Pose> site_from_scan;
  double face_chainage_m = 0.0;  ///< mean over the design area
  double from_m = 0.0;
  double to_m = 0.0;
  VolumeAmounts volume;  ///< of [from, to] with plan curvature
  std::vector<TrueSection> sections;
};

/// With d the deviation, k the curvature of the line and n_x the normal's part to the right, a piece dp of the line
/// holds
///   over:  d + k d^2/2 of area and x d + (x k + n_x) d^2/2 + n_x k d^3/3 of first moment,
/// the same with signs for underbreak (no deeper than the medial axis), and wedges at convex corners.
TrueSection true_section(const RockTunnel& tunnel, double chainage_m);

/// Integral of (area - plan curvature * moment) over [from, to] by the midpoint rule in steps of about 2 cm.
VolumeAmounts true_volume(const RockTunnel& tunnel, double from_m, double to_m, Progress& progress);

/// Mean chainage of the face over the design area.
double true_face_chainage(const RockTunnel& tunnel);

}  // namespace adit
