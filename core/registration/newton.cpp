#include "core/registration/newton.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "core/geometry/pose_step.h"

namespace adit {
namespace {

/// The Newton step in metres (turns times lever): |eigenvalues| of the Hessian, none less than a share of the greatest.
Vector6d newton_step(const NdtScore& at, double lever_m, const Eigen::Vector3d& held_direction) {
  constexpr double least_share = 1e-4;
  Matrix6d to_metres = Matrix6d::Identity();
  to_metres.diagonal().head<3>().setConstant(1.0 / lever_m);
  to_metres.bottomRightCorner<3, 3>() -= held_direction * held_direction.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(to_metres * at.hessian * to_metres);
  const Vector6d sizes = axes.eigenvalues().cwiseAbs();
  const Vector6d curvature = sizes.cwiseMax(least_share * sizes.maxCoeff());
  const Vector6d gradient = to_metres * at.gradient;
  return -(axes.eigenvectors() * curvature.cwiseInverse().asDiagonal() * axes.eigenvectors().transpose() * gradient);
}

}  // namespace

NewtonResult descend(const Pose& start, const std::function<NdtScore(const Pose&)>& score,
                     const NewtonOptions& options) {
  constexpr double armijo = 1e-4;
  constexpr int most_halvings = 8;
  NewtonResult result{start, score(start), 0};
  while (result.iterations < options.most_iterations) {
    if (!(result.at.hessian.cwiseAbs().maxCoeff() > 0.0)) break;
    Vector6d step = newton_step(result.at, options.lever_m, options.held_direction);
    step *= std::min(1.0, options.longest_step_m / std::max(step.norm(), 1e-300));
    Vector6d scaled = step;
    scaled.head<3>() /= options.lever_m;
    const double slope = scaled.dot(result.at.gradient);
    double share = 1.0;
    bool better = false;
    for (int halving = 0; halving <= most_halvings && !better; ++halving) {
      const Pose tried = stepped(result.pose, share * scaled);
      const NdtScore at = score(tried);
      better = at.score <= result.at.score + armijo * share * slope;
      if (better) {
        result.pose = tried;
        result.at = at;
      } else {
        share *= 0.5;
      }
    }
    ++result.iterations;
    if (!better || share * step.norm() < options.least_step_m) break;
  }
  return result;
}

}  // namespace adit
