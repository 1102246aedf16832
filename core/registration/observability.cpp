#include "core/registration/observability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"

namespace adit {
namespace {

constexpr std::size_t directions = 6;
constexpr int along = 0;
constexpr double unknown_m = 10.0;  // variances of 100 m2 tell nothing and keep the inverse well conditioned

/// Symmetric matrix with eigenvalues no smaller than floor.
Eigen::MatrixXd floored(const Eigen::MatrixXd& matrix, double floor) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (matrix + matrix.transpose()));
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(floor).asDiagonal() * eigen.eigenvectors().transpose();
}

/// Columns: (rotation, translation) for a metre in each direction of direction_names; turns are metres at the lever.
Matrix6d metres_in(const Eigen::Matrix3d& axes, double lever_m) {
  Matrix6d columns = Matrix6d::Zero();
  columns.bottomLeftCorner<3, 3>() = axes.transpose();
  columns.topRightCorner<3, 3>() = axes.transpose() / lever_m;
  return columns;
}

double radius_of_gyration(std::span<const SurfaceMatch> matches) {
  double sum = 0.0;
  for (const SurfaceMatch& match : matches) sum += match.arm.squaredNorm();
  return matches.empty() ? 1.0 : std::max(0.1, std::sqrt(sum / static_cast<double>(matches.size())));
}

std::vector<Eigen::Index> free_of(const HeldDirections& held) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < directions; ++i)
    if (!held[i]) free.push_back(static_cast<Eigen::Index>(i));
  return free;
}

/// Everything in metres of the six directions.
struct Known {
  Matrix6d hessian, noise;
  std::vector<std::vector<CubeSums>> cubes;  ///< of several sizes
  double robust_share;                       ///< of the hessian that counts with Tukey's weights
};

/// The covariance S^-1 (sum of f f^T) S^-1 with f each cube's gradient as it would be had the cube not pulled the
/// solution towards itself: its residuals are too small by that (Bell and McCaffrey 2002, the jackknife's CR3). A cube
/// that holds nearly all there is of a direction leaves nothing to measure its error by: unknown.
Eigen::MatrixXd jackknife_covariance(const std::vector<CubeSums>& cubes, const Eigen::MatrixXd& signal,
                                     double robust_share, const std::vector<Eigen::Index>& free) {
  constexpr double all_there_is = 0.98;
  const auto size = signal.rows();
  const Eigen::MatrixXd lower = signal.llt().matrixL();
  const Eigen::MatrixXd whiten = lower.inverse();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (const CubeSums& cube : cubes) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> shares(robust_share * whiten * cube.hessian(free, free) *
                                                                whiten.transpose());
    const Eigen::MatrixXd moves = whiten.transpose() * shares.eigenvectors();
    const Eigen::VectorXd pulls = moves.transpose() * Eigen::VectorXd(cube.gradient(free));
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(size);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double share = shares.eigenvalues()[i];
      if (share < all_there_is) {
        moved += pulls[i] / (1.0 - share) * moves.col(i);
        continue;
      }
      const Eigen::VectorXd direction = moves.col(i) / moves.col(i).lpNorm<Eigen::Infinity>();
      sum += unknown_m * unknown_m * direction * direction.transpose();
    }
    sum += moved * moved.transpose();
  }
  return sum;
}

/// Of the sizes of cubes that which makes the most of the errors.
Eigen::MatrixXd covariance_of(const Known& known, const std::vector<Eigen::Index>& free) {
  const Eigen::MatrixXd hessian = known.hessian(free, free);
  const Eigen::MatrixXd signal =
      floored(known.robust_share * hessian - known.noise(free, free), 1e-9 * hessian.trace());
  std::vector<Eigen::MatrixXd> by_size(known.cubes.size());
  const auto measure = [&](std::size_t i) {
    by_size[i] = jackknife_covariance(known.cubes[i], signal, known.robust_share, free);
  };
  parallel_for_each_index(by_size.size(), measure, 1);
  Eigen::MatrixXd worst = Eigen::MatrixXd::Zero(hessian.rows(), hessian.cols());
  for (const Eigen::MatrixXd& covariance : by_size) {
    if (!covariance.allFinite())  // no hessian at all
      return unknown_m * unknown_m * Eigen::MatrixXd::Identity(hessian.rows(), hessian.rows());
    if (covariance.trace() > worst.trace()) worst = covariance;
  }
  return worst;
}

/// What the matches say, in metres of the columns.
Known known_of(std::span<const SurfaceMatch> matches, double tukey_m, const Matrix6d& columns) {
  // However alike the normals of both sides are, none is better known than this: a wall without any noise would
  // otherwise be known along itself.
  constexpr double least_normal_error = 1e-3;
  constexpr std::size_t enough_cubes = 24;  // of fewer, in small rooms, no spread can be told
  constexpr std::size_t sizes = 3;          // 1, 2 and 4 m
  const NormalEquations equations = normal_equations(matches, tukey_m);
  const auto in_metres = [&](const Matrix6d& matrix) { return Matrix6d(columns.transpose() * matrix * columns); };
  Known known{
      in_metres(equations.hessian),
      in_metres(equations.noise) + least_normal_error * least_normal_error * equations.weight * Matrix6d::Identity(),
      {sums_by_cubes(matches, tukey_m, 1.0)},
      std::clamp(equations.curvature / std::max(equations.weight, 1e-9), 0.3, 1.0)};
  for (CubeSums& cube : known.cubes.front()) {
    cube.hessian = in_metres(cube.hessian);
    cube.gradient = columns.transpose() * cube.gradient;
  }
  while (known.cubes.size() < sizes) known.cubes.push_back(with_double_cubes(known.cubes.back()));
  while (known.cubes.size() > 1 && known.cubes.back().size() < enough_cubes) known.cubes.pop_back();
  return known;
}

/// A metre in one free direction, the other free ones following, and how much more than the limit allows is unknown.
struct Weakness {
  std::size_t which = 0;  ///< of the free directions
  Vector6d direction = Vector6d::Zero();
  double ratio = 0.0;  ///< over 1: undetermined
};

Weakness weakness_of(const Known& known, const std::vector<Eigen::Index>& free, std::size_t which, double sigma_m,
                     double limit_m) {
  const auto n = static_cast<Eigen::Index>(which);
  const Eigen::MatrixXd hessian = known.hessian(free, free);
  const auto size = hessian.rows();
  const Eigen::MatrixXd regular = hessian + 1e-9 * (hessian.trace() + 1e-9) * Eigen::MatrixXd::Identity(size, size);
  const Eigen::VectorXd column = regular.ldlt().solve(Eigen::VectorXd::Unit(size, n));
  Weakness weakness;
  weakness.which = which;
  weakness.direction(free) = column / column[n];
  const double noise = weakness.direction.dot(known.noise * weakness.direction);
  weakness.ratio = std::max(sigma_m / limit_m, 3.0 * noise * column[n]);
  return weakness;
}

Weakness weakest_of(const Known& known, const std::vector<Eigen::Index>& free, const Eigen::MatrixXd& covariance,
                    double limit_m) {
  Weakness weakest;
  for (std::size_t n = 0; n < free.size(); ++n) {
    const auto at = static_cast<Eigen::Index>(n);
    const Weakness weakness = weakness_of(known, free, n, std::sqrt(std::max(covariance(at, at), 0.0)), limit_m);
    if (weakness.ratio > weakest.ratio) weakest = weakness;
  }
  return weakest;
}

/// A metre in a held direction, the free ones following as the surfaces ask.
Vector6d way_of(const Known& known, const std::vector<Eigen::Index>& free, Eigen::Index direction) {
  Vector6d way = Vector6d::Unit(direction);
  if (free.empty()) return way;
  const Matrix6d signal = known.robust_share * known.hessian - known.noise;
  const Eigen::VectorXd coupling = signal.col(direction)(free);
  way(free) = -floored(signal(free, free), 1e-9 * known.hessian.trace()).ldlt().solve(coupling);
  return way;
}

/// Sigma of what a tangent leaves out of a curve: half the curvature times the root mean square of the way's square.
double bend_m(const Vector6d& way_along, double lever_m, double guess_sigma_m) {
  return 0.5 * std::sqrt(3.0) * way_along.tail<3>().norm() / lever_m * guess_sigma_m * guess_sigma_m;
}

double& sigma_of(PoseSigma& sigma, std::size_t direction) {
  double* const members[] = {&sigma.along_m,  &sigma.across_m,  &sigma.up_m,
                             &sigma.roll_rad, &sigma.pitch_rad, &sigma.yaw_rad};
  return *members[direction];
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

Pose held_at(const Pose& to, const Pose& target_from_source, const HeldDirections& held, const Eigen::Matrix3d& axes) {
  Eigen::Vector3d move = axes * (target_from_source.translation() - to.translation());
  Eigen::Vector3d turn = axes * rotation_vector(target_from_source.linear() * to.linear().transpose());
  for (std::size_t i = 0; i < 3; ++i) {
    if (held[i]) move[static_cast<Eigen::Index>(i)] = 0.0;
    if (held[i + 3]) turn[static_cast<Eigen::Index>(i)] = 0.0;
  }
  Pose pose = to;
  pose.linear() = rotation_from_vector(axes.transpose() * turn) * to.linear();
  pose.translation() += axes.transpose() * move;
  return pose;
}

Vector6d step_without(const NormalEquations& equations, const HeldDirections& held, const Eigen::Matrix3d& axes) {
  const std::vector<Eigen::Index> free = free_of(held);
  const Eigen::MatrixXd columns = metres_in(axes, 5.0)(Eigen::all, free);
  const Eigen::MatrixXd hessian = columns.transpose() * equations.hessian * columns;
  const auto size = hessian.rows();
  const Eigen::MatrixXd damped = hessian + 1e-6 * equations.weight * Eigen::MatrixXd::Identity(size, size);
  return -columns * damped.ldlt().solve(columns.transpose() * equations.gradient);
}

Slide slide_between(const Pose& from, const Pose& to, const Eigen::Vector3d& axis) {
  const Eigen::Vector3d turn = rotation_vector(to.linear() * from.linear().transpose());
  const Eigen::Vector3d chord = to.translation() - from.translation();
  const Eigen::Vector3d tangent = rotation_from_vector(-0.5 * turn) * chord;
  const double along_m = axis.dot(tangent);
  return {turn / along_m, tangent / along_m};
}

Pose slid(const Pose& pose, const Slide& slide, double length) {
  Pose moved = pose;
  moved.linear() = rotation_from_vector(length * slide.turn_rad) * pose.linear();
  moved.translation() += rotation_from_vector(0.5 * length * slide.turn_rad) * (length * slide.shift_m);
  return moved;
}

Pose put_back(const Pose& to, const Pose& target_from_source, const HeldDirections& held,
              const std::array<Slide, 6>& ways, const Eigen::Matrix3d& axes) {
  constexpr int turns = 4;             // each way may take the others along
  constexpr double longest_way = 1.0;  // a radian of roll is about the greatest a transform drifts
  Pose pose = target_from_source;
  for (int turn = 0; turn < turns; ++turn)
    for (std::size_t i = 0; i < directions; ++i) {
      if (!held[i]) continue;
      const Eigen::Vector3d axis = axes.row(static_cast<Eigen::Index>(i % 3)).transpose();
      const double left = i < 3 ? axis.dot(to.translation() - pose.translation())
                                : axis.dot(rotation_vector(to.linear() * pose.linear().transpose()));
      pose = slid(pose, ways[i], std::clamp(left, -longest_way, longest_way));
    }
  return held_at(to, pose, held, axes);
}

PairInformation judge_observability(std::span<const SurfaceMatch> matches, double tukey_m,
                                    const Eigen::Matrix3d& axes_in_target, const ObservabilityLimits& limits,
                                    const HeldDirections& held, const std::optional<Slide>& slide) {
  const double lever_m = radius_of_gyration(matches);
  const Matrix6d columns = metres_in(axes_in_target, lever_m);
  const Matrix6d into_metres = columns.inverse();
  const Known known = known_of(matches, tukey_m, columns);
  PairInformation result;
  result.undetermined = held;
  if (matches.size() < least_matches) result.undetermined.fill(true);
  std::vector<Eigen::Index> free = free_of(result.undetermined);
  Matrix6d ways = Matrix6d::Zero();  // columns: of the undetermined directions
  for (Eigen::Index i = 0; i < ways.cols(); ++i)
    if (result.undetermined[static_cast<std::size_t>(i)]) ways.col(i) = way_of(known, free, i);
  if (result.undetermined[along] && slide)
    ways.col(along) << axes_in_target * slide->shift_m, lever_m * (axes_in_target * slide->turn_rad);
  Matrix6d covariance = Matrix6d::Zero();
  while (!free.empty()) {
    Eigen::MatrixXd of_free = covariance_of(known, free);
    const Weakness weakest = weakest_of(known, free, of_free, limits.undetermined_sigma_m);
    if (weakest.ratio <= 1.0) {
      of_free.diagonal().array() += std::max(1e-14, limits.least_sigma_m * limits.least_sigma_m);
      covariance(free, free) = of_free;
      break;
    }
    const Eigen::Index which = free[weakest.which];
    result.undetermined[static_cast<std::size_t>(which)] = true;
    ways.col(which) = weakest.direction;
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(weakest.which));
  }
  for (std::size_t i = 0; i < directions; ++i) {
    const Vector6d way = ways.col(static_cast<Eigen::Index>(i)) * (i < 3 ? 1.0 : lever_m);
    result.ways[i] = {axes_in_target.transpose() * way.tail<3>() / lever_m, axes_in_target.transpose() * way.head<3>()};
  }
  const double bent_m = bend_m(ways.col(along), lever_m, limits.guess_sigma_m);
  covariance.diagonal().segment<2>(along + 1).array() += bent_m * bent_m;
  for (const Vector6d& other : limits.other_answers) {
    Vector6d metres = Vector6d::Zero();
    metres(free) = Vector6d(into_metres * other)(free);
    covariance += metres * metres.transpose();
  }
  Vector6d sigma_m = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  for (std::size_t i = 0; i < directions; ++i)
    if (result.undetermined[i]) sigma_m[static_cast<Eigen::Index>(i)] = unknown_m;
  covariance += unknown_m * unknown_m * ways * ways.transpose();
  for (std::size_t i = 0; i < directions; ++i)
    sigma_of(result.sigma, i) = sigma_m[static_cast<Eigen::Index>(i)] / (i < 3 ? 1.0 : lever_m);
  result.information = into_metres.transpose() * covariance.inverse() * into_metres;
  return result;
}

}  // namespace adit
