#include "core/registration/scale_check.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace adit {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;
constexpr Eigen::Index growth = 6;

/// What the pose's six and growing by one do to the residual.
Vector7d answers_of(const SurfaceMatch& match) {
  Vector7d answers;
  answers << jacobian_of(match), match.arm.dot(match.normal);
  return answers;
}

struct Equations {
  Matrix7d hessian = Matrix7d::Zero();
  Vector7d gradient = Vector7d::Zero();
};

/// Evenly taken.
std::vector<SurfaceMatch> part_of(std::span<const SurfaceMatch> matches) {
  constexpr std::size_t enough = 8192;
  const std::size_t step = matches.size() / enough + 1;
  std::vector<SurfaceMatch> part;
  for (std::size_t i = 0; i < matches.size(); i += step) part.push_back(matches[i]);
  return part;
}

/// Weighted as the residuals are after `moved`.
Equations equations_after(std::span<const SurfaceMatch> matches, const Vector7d& moved, double tukey_m) {
  Equations sums;
  double weights = 0.0;
  for (const SurfaceMatch& match : matches) {
    const Vector7d answers = answers_of(match);
    const double residual_m = match.residual_m + answers.dot(moved);
    const double weight = tukey_weight(residual_m, tukey_m);
    sums.hessian.noalias() += weight * answers * answers.transpose();
    sums.gradient += weight * residual_m * answers;
    weights += weight;
  }
  sums.hessian.diagonal().head<growth>().array() += 1e-6 * weights + 1e-12;  // what nothing determines stays
  return sums;
}

}  // namespace

ScaleCheck check_scale(std::span<const SurfaceMatch> all, double tukey_m) {
  constexpr double cube_m = 2.0;
  constexpr int most_steps = 10;
  constexpr double still = 1e-7;
  if (all.size() < least_matches) return {};
  const std::vector<SurfaceMatch> matches = part_of(all);
  Vector7d moved = Vector7d::Zero();
  Equations equations = equations_after(matches, moved, tukey_m);
  for (int i = 0; i < most_steps; ++i) {
    if (!(equations.hessian(growth, growth) > 0.0)) return {};
    const Vector7d step = equations.hessian.ldlt().solve(equations.gradient);
    moved -= step;
    equations = equations_after(matches, moved, tukey_m);
    if (std::abs(step[growth]) < still) break;
  }
  // The growth that the pose does not follow (Frisch and Waugh 1933).
  Vector7d own = Vector7d::Unit(growth);
  own.head<growth>() = -equations.hessian.topLeftCorner<growth, growth>().ldlt().solve(
      Vector6d(equations.hessian.col(growth).head<growth>()));
  double weights = 0.0, bends = 0.0, squares = 0.0;
  std::map<std::uint64_t, double> pull_of_cube;
  for (const SurfaceMatch& match : matches) {
    const Vector7d answers = answers_of(match);
    const double residual_m = match.residual_m + answers.dot(moved), alone = own.dot(answers);
    const double weight = tukey_weight(residual_m, tukey_m);
    weights += weight;
    bends += tukey_curvature(residual_m, tukey_m);
    squares += weight * alone * alone;
    pull_of_cube[cell_key(in_cells(match.arm, cube_m))] += weight * alone * residual_m;
  }
  if (!(squares > 0.0)) return {};
  double spread = 0.0;
  for (const auto& [cube, pull] : pull_of_cube) spread += pull * pull;
  const double robust_share = std::clamp(bends / weights, 0.3, 1.0);
  return {1.0 + moved[growth], std::sqrt(spread) / (robust_share * squares)};
}

}  // namespace adit
