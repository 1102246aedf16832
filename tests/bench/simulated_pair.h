#pragma once
// Two scans of a simulated tunnel, 8 m apart, and how they truly lie.

#include "core/geometry/point_cloud.h"
#include "core/geometry/pose.h"

namespace adit::bench {

inline constexpr int simulated_pairs = 5;  ///< those that the tables use: seeds 1 to 5

struct SimulatedPair {
  PointCloud target, source;
  Pose truth = Pose::Identity();  ///< target_from_source
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
};

/// Of 900,000 pulses each with 5 mm noise; straight and curved in turn.
SimulatedPair simulated_pair(std::uint64_t seed);

}  // namespace adit::bench
