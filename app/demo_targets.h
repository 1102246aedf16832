#pragma once
// Targets that the scanners of a synthetic job see.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/job/job.h"
#include "core/simulation/rock_tunnel.h"
#include "core/simulation/scanned_targets.h"

namespace adit::app {

/// Spheres of 145 mm, boards of quarters of 300 mm and coded ones of 300 mm by turns, one every 1.3 m, on both walls
/// and the roof; boards face those who come up the chainage. Frame: the tunnel's.
std::vector<ScannedTarget> hung_scan_targets(const RockTunnel& tunnel, double from_m, double to_m);

/// Writes control.csv (survey's noise: 0.7 mm), in which coded ones stand by their number, and tells the job to look
/// for the targets. origin: site minus local.
void write_scan_targets(const std::vector<ScannedTarget>& targets, const Eigen::Vector3d& origin, std::uint64_t seed,
                        const std::filesystem::path& folder, Job& job);

}  // namespace adit::app
