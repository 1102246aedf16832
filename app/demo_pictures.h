#pragma once
// Cameras, targets and pictures of a synthetic job.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/foundation/progress.h"
#include "core/job/job.h"
#include "core/simulation/rock_tunnel.h"
#include "render/gl_context.h"

namespace adit::app {

/// What pictures are taken of, and from where.
struct DemoPictures {
  const RockTunnel& tunnel;  ///< local frame
  Eigen::Vector3d origin;    ///< site minus local
  double from_m;             ///< where targets hang
  double to_m;
  std::vector<Pose> stations;  ///< true local_from_scan, x along the tunnel
  std::uint64_t seed;
};

/// Writes camera.yaml, landmarks.csv and pictures/S1.png, ... into the folder, and adds them to the job. The lever arm
/// that the job is told is off by as much as its sigmas say. Draws in the context, which is current.
void write_demo_pictures(const DemoPictures& demo, const std::filesystem::path& folder, Job& job, Progress& progress);

}  // namespace adit::app
