#pragma once
// The point-to-plane normal equations of a pair: what drives the last refinement and what tells which directions are
// known.

#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/prepared_scan.h"

namespace adit {

/// Sums over matched points q (source point moved into the target frame) with the target's normal n and residual
/// r = n . (q - t): with J = [(q - o) x n, n] (rotation [rad] about the source's origin o, then translation [m]; Chen
/// and Medioni 1992), hessian = sum w J^T J, gradient = sum w J^T r. `noise` is the part of the hessian that comes from
/// the normals' own uncertainty: sum w B (I - n n^T) B^T var(n) with B = [[q - o]x; I]. A featureless wall seen with
/// noise has a hessian along itself made of noise alone.
struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double weight = 0.0;
  std::vector<double> residuals_m;  ///< of every match within reach, unweighted
  std::vector<double> distances_m;  ///< to the nearest target point
  std::size_t looked_at = 0;        ///< source points tried

  NormalEquations& operator+=(const NormalEquations& other);
};

/// Tukey's biweight with the given reach; matches farther than match_distance_m are none.
NormalEquations point_to_plane_equations(const PreparedScan& target, const PreparedScan& source,
                                         const Pose& target_from_source, double match_distance_m, double tukey_m,
                                         Progress& progress);

}  // namespace adit
