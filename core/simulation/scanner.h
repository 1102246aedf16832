#pragma once
// A laser scanner with two rotation axes in a simulated tunnel.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/point_cloud.h"
#include "core/geometry/pose.h"
#include "core/simulation/rock_tunnel.h"
#include "core/simulation/scanned_targets.h"

namespace adit {

struct ScannerOptions {
  std::uint64_t seed = 1;
  std::uint64_t pulses = 1000000;  ///< sent over the field of view, evenly in both angles
  double least_range_m = 0.6;
  double most_range_m = 45.0;
  double lowest_elevation_deg = -62.0;  ///< the tripod hides what is below
  double highest_elevation_deg = 90.0;
  double from_azimuth_deg = 0.0;  ///< a sector, counter-clockwise from x
  double to_azimuth_deg = 360.0;
  double range_sigma_m = 0.0025;  ///< at square incidence; grows with obliqueness
  double angle_sigma_rad = 4e-5;
  double dropout = 0.004;              ///< lost at square incidence and short range; more when dim
  std::vector<ScannedTarget> targets;  ///< tunnel's frame; the beam (5 mm wide and 0.3 mrad) averages over them
};

/// One scan in its own frame: x forward, z up along the standing axis, column by column. intensity in [0, 1]. Handed to
/// `take` a few columns at a time, in order: memory does not grow with the scan. tunnels: those of a RayCast; frame:
/// theirs.
void scan_tunnel(std::span<const RockTunnel> tunnels, const Pose& design_from_scan, const ScannerOptions& options,
                 const std::vector<Eigen::Vector2d>& people, const std::function<void(const PointCloud&)>& take,
                 Progress& progress);

/// The same in memory.
PointCloud scan_tunnel(std::span<const RockTunnel> tunnels, const Pose& design_from_scan, const ScannerOptions& options,
                       const std::vector<Eigen::Vector2d>& people, Progress& progress);
inline PointCloud scan_tunnel(const RockTunnel& tunnel, const Pose& design_from_scan, const ScannerOptions& options,
                              const std::vector<Eigen::Vector2d>& people, Progress& progress) {
  return scan_tunnel(std::span(&tunnel, 1), design_from_scan, options, people, progress);
}

}  // namespace adit
