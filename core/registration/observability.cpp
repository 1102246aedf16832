#include "core/registration/observability.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace adit {
namespace {

/// Symmetric matrix with eigenvalues no smaller than floor.
Matrix6d floored(const Matrix6d& matrix, double floor) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 * (matrix + matrix.transpose()));
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(floor).asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Eigen::Matrix3d tunnel_axes(const Eigen::Vector3d& axis_direction) {
  const Eigen::Vector3d along = axis_direction.normalized();
  Eigen::Vector3d across = along.cross(Eigen::Vector3d::UnitZ());
  if (across.norm() < 1e-6) across = Eigen::Vector3d::UnitX();  // a shaft: any horizontal direction will do
  across.normalize();
  Eigen::Matrix3d axes;
  axes << along.transpose(), across.transpose(), across.cross(along).transpose();
  return axes;
}

PoseSigma sigma_in_axes(const Matrix6d& covariance, const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d turn = axes * covariance.topLeftCorner<3, 3>() * axes.transpose();
  const Eigen::Matrix3d move = axes * covariance.bottomRightCorner<3, 3>() * axes.transpose();
  const auto root = [](double variance) { return std::sqrt(std::max(variance, 0.0)); };
  return {root(move(0, 0)), root(move(1, 1)), root(move(2, 2)), root(turn(0, 0)), root(turn(1, 1)), root(turn(2, 2))};
}

PairInformation judge_observability(const NormalEquations& equations, double noise_sigma_m, double spacing_m,
                                    const Eigen::Matrix3d& axes_in_target, double undetermined_sigma_m) {
  constexpr double independent_area_m2 = 0.25;
  const double matches_in_one = std::max<double>(normal_neighbours, independent_area_m2 / (spacing_m * spacing_m));
  const double scale = 1.0 / (noise_sigma_m * noise_sigma_m * matches_in_one);
  const Matrix6d signal = floored((equations.hessian - equations.noise) * scale, 1e-3);
  PairInformation result;
  result.sigma = sigma_in_axes(signal.inverse(), axes_in_target);

  constexpr std::array<const char*, 3> names{"along", "across", "up"};
  const std::array<double, 3> sigmas{result.sigma.along_m, result.sigma.across_m, result.sigma.up_m};
  Matrix6d keep = Matrix6d::Identity();
  for (int axis = 0; axis < 3; ++axis) {
    Vector6d direction = Vector6d::Zero();
    direction.tail<3>() = axes_in_target.row(axis).transpose();
    const double whole = direction.dot(equations.hessian * direction);
    const double noise = direction.dot(equations.noise * direction);
    const bool mostly_noise = !(whole > 3.0 * noise);
    if (!mostly_noise && sigmas[static_cast<std::size_t>(axis)] <= undetermined_sigma_m) continue;
    result.undetermined.emplace_back(names[static_cast<std::size_t>(axis)]);
    result.undetermined_axes.emplace_back(direction.tail<3>());
    keep -= direction * direction.transpose();
  }
  // Marginal over the undetermined directions: what is known of the others without claiming anything about these.
  Matrix6d loose = signal.inverse();
  for (const auto& axis : result.undetermined_axes) loose.bottomRightCorner<3, 3>() += 1e6 * axis * axis.transpose();
  result.information = floored(keep * loose.inverse() * keep, 0.0);
  return result;
}

}  // namespace adit
