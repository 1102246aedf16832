#pragma once
// Newton's method on a pose.

#include <functional>

#include "core/geometry/pose.h"
#include "core/registration/ndt_score.h"

namespace adit {

struct NewtonOptions {
  int most_iterations = 30;
  double longest_step_m = 1.0;
  double lever_m = 5.0;                                      ///< a turn by a radian is worth a shift by so many metres
  Eigen::Vector3d held_direction = Eigen::Vector3d::Zero();  ///< unit, not moved along; zero: none
  double least_step_m = 1e-4;                                ///< shorter steps (and turns worth as much) end the search
};

struct NewtonResult {
  Pose pose = Pose::Identity();
  NdtScore at;  ///< of the pose
  int iterations = 0;
};

/// Least score near a pose. Directions in which the score is not convex are descended along their gradient; no step
/// makes the score worse (backtracking after Armijo).
NewtonResult descend(const Pose& start, const std::function<NdtScore(const Pose&)>& score,
                     const NewtonOptions& options);

}  // namespace adit
