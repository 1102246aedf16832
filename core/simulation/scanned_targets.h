#pragma once
// Targets that a simulated scanner sees: spheres, boards of black and white quarters, coded boards.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/geometry/pose.h"
#include "core/georeference/coded_pattern.h"
#include "core/georeference/scan_targets.h"

namespace adit {

/// Frame: the tunnel's. A board's pattern lies in its plane z = 0, x right, y up, z towards who looks at it; a sphere
/// stands about the origin.
struct ScannedTarget {
  TargetKind kind = TargetKind::sphere;
  Pose pose = Pose::Identity();
  double radius_m = 0.0725;  ///< of the sphere, of the round board of quarters, of the coded ring
  TargetCode code = 0;
};

/// How far a board reaches from its centre: coded ones have a rim of white paper.
double board_radius_m(const ScannedTarget& target);

struct TargetHit {
  double range_m = 0.0;
  double incidence_cosine = 0.0;
  double albedo = 0.0;
};

/// The nearest target along a ray (direction of unit length).
std::optional<TargetHit> first_target_hit(const std::vector<ScannedTarget>& targets, const Eigen::Vector3d& origin,
                                          const Eigen::Vector3d& direction);

}  // namespace adit
