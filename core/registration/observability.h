#pragma once
// Which directions do the clouds determine? Covariance in tunnel axes.

#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/registration/normal_equations.h"
#include "core/registration/registration.h"

namespace adit {

/// Rows: unit vectors along, across (to the right), up, for an axis direction [any frame with z about up].
Eigen::Matrix3d tunnel_axes(const Eigen::Vector3d& axis_direction);

/// Standard deviations in tunnel axes of a 6x6 covariance of (rotation, translation) in the frame of the axes.
PoseSigma sigma_in_axes(const Matrix6d& covariance, const Eigen::Matrix3d& axes);

/// Information of a pair about (rotation [rad], translation [m]) in the target's frame at the source's origin, and the
/// directions in which it has none.
struct PairInformation {
  Matrix6d information = Matrix6d::Zero();         ///< zero along undetermined directions
  PoseSigma sigma;                                 ///< before anything is held
  std::vector<std::string> undetermined;           ///< "along", "across", "up"
  std::vector<Eigen::Vector3d> undetermined_axes;  ///< unit, target's frame
};

/// The hessian less its noise part, over the noise variance of a residual. Neighbouring points share their plane and
/// the scanner's own slow errors, so that a quarter of a square metre of surface (and no less than `normal_neighbours`
/// matches) is counted as one independent match, whatever the spacing. A direction is undetermined when its sigma
/// (rotation eliminated by the Schur complement) exceeds the limit, or when less than two thirds of its hessian are
/// more than noise.
PairInformation judge_observability(const NormalEquations& equations, double noise_sigma_m, double spacing_m,
                                    const Eigen::Matrix3d& axes_in_target, double undetermined_sigma_m);

}  // namespace adit
