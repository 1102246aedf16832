#include "core/registration/scale_check.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <map>

namespace adit {
namespace {

/// What growing by one does to the residual.
double growth(const SurfaceMatch& match) {
  return match.arm.dot(match.normal);
}

/// The pose's answer to growing by one: what is left of growth is J-free.
Vector6d pose_of_growth(std::span<const SurfaceMatch> matches, double tukey_m) {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d mixed = Vector6d::Zero();
  double weights = 0.0;
  for (const SurfaceMatch& match : matches) {
    const Vector6d j = jacobian_of(match);
    const double weight = tukey_weight(match.residual_m, tukey_m);
    hessian.noalias() += weight * j * j.transpose();
    mixed += weight * growth(match) * j;
    weights += weight;
  }
  hessian.diagonal().array() += 1e-6 * weights + 1e-12;  // directions that nothing determines follow no growth
  return hessian.ldlt().solve(mixed);
}

}  // namespace

ScaleCheck check_scale(std::span<const SurfaceMatch> matches, double tukey_m) {
  constexpr double cube_m = 2.0;
  if (matches.size() < least_matches) return {};
  const Vector6d follows = pose_of_growth(matches, tukey_m);
  const auto left = [&](const SurfaceMatch& match) { return growth(match) - follows.dot(jacobian_of(match)); };
  double squares = 0.0, product = 0.0;
  for (const SurfaceMatch& match : matches) {
    const double weight = tukey_weight(match.residual_m, tukey_m), own = left(match);
    squares += weight * own * own;
    product += weight * own * match.residual_m;
  }
  if (!(squares > 0.0)) return {};
  const double grown = -product / squares;
  std::map<std::uint64_t, double> pull_of_cube;
  for (const SurfaceMatch& match : matches) {
    const double own = left(match);
    pull_of_cube[cell_key(in_cells(match.arm, cube_m))] +=
        tukey_weight(match.residual_m, tukey_m) * own * (match.residual_m + own * grown);
  }
  double spread = 0.0;
  for (const auto& [cube, pull] : pull_of_cube) spread += pull * pull;
  return {1.0 + grown, std::sqrt(spread) / squares};
}

}  // namespace adit
