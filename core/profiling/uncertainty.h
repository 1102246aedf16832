#pragma once
// From noise, registration and coverage to the uncertainty of volumes.

#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/profiling.h"

namespace adit {

/// Of the scans together: the worst of each, and the datum that they share.
PoseSigma common_sigma(const RegistrationResult& registration);

/// How far everything measured may lie off together: by the scans, across and up, and by a systematic error of
/// distances, which counts by the cosine of incidence.
struct SurfaceSigma {
  double across_m = 0.0;
  double up_m = 0.0;
  double distance_m = 0.0;
  /// Along an outward normal (x, z) of the section.
  double along_normal(const Eigen::Vector2d& normal, double incidence) const;
};
SurfaceSigma surface_sigma(const RegistrationResult& registration, const ProfilingOptions& options);
/// Of one cell's own deviation, its points' noise alone: squared.
double noise_squared_m2(const MapCell& cell);

/// First-order propagation over the map (docs/accuracy.md, uncertainty of volumes). A piece of surface of area a with
/// outward normal n changes the volume by a (n . t) when the scans move by t, and by a b when distances are off by b.
/// Counted: datum and registration (across and up over the surface, along at both ends), a common bias of the
/// distances, point noise, interpolated pieces (spread of the rock, correlated over half a square metre) and unseen
/// pieces (mean deviation of what was seen about the same place of the profile, fully correlated). Overbreak counts
/// what lies outside the line, underbreak what lies inside.
enum class VolumePart { excavated, over, under };
double volume_sigma_m3(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                       double to_m, VolumePart part, const RegistrationResult& registration,
                       const ProfilingOptions& options);

}  // namespace adit
