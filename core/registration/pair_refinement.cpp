#include "core/registration/pair_refinement.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"
#include "core/registration/icp.h"

namespace adit {
namespace {

/// Of an even part of the matches: enough for their spread.
std::vector<double> residuals_of(std::span<const SurfaceMatch> matches) {
  constexpr std::size_t enough = 8192;
  const std::size_t step = matches.size() / enough + 1;
  std::vector<double> residuals;
  for (std::size_t i = 0; i < matches.size(); i += step) residuals.push_back(matches[i].residual_m);
  return residuals;
}

/// least_reach_m: of Tukey's weights, however little the noise.
std::optional<Vector6d> step_of(const SurfaceMap& target, const SurfaceMap& source, const Pose& pose,
                                const HeldDirections& held, const Eigen::Matrix3d& axes, std::span<const Stretch> apart,
                                double least_reach_m, Progress& progress) {
  const std::vector<SurfaceMatch> matches = outside(apart, surface_matches(target, source, pose, progress), pose, axes);
  if (matches.size() < least_matches) return std::nullopt;
  const double reach_m = std::max(least_reach_m, tukey_reach_m(matches, target.cell_m()));
  const NormalEquations equations = normal_equations(matches, reach_m);
  return Vector6d(step_without(equations, held, axes) / equations.bend());
}

/// The reach is first_reach_m, then reach_falls of it, and so on down to what the noise asks for: walls that fit
/// already would otherwise shut out a floor that does not yet.
Pose stepped_to_rest(const SurfaceMap& target, const SurfaceMap& source, Pose pose, const HeldDirections& held,
                     const Eigen::Matrix3d& axes, std::span<const Stretch> apart, double first_reach_m,
                     double least_step_m, Progress& progress) {
  constexpr int most_steps = 15;
  constexpr double lever_m = 5.0;
  constexpr double least_reach_m = 0.005;
  constexpr double reach_falls = 0.3;
  double reach_m = first_reach_m;
  for (int i = 0; i < most_steps; ++i, reach_m *= reach_falls) {
    const auto step = step_of(target, source, pose, held, axes, apart, reach_m, progress);
    if (!step) break;
    pose = stepped(pose, *step);
    if (reach_m < least_reach_m && step->tail<3>().norm() + lever_m * step->head<3>().norm() < least_step_m) break;
  }
  return pose;
}

}  // namespace

double tukey_reach_m(std::span<const SurfaceMatch> matches, double cell_m) {
  return std::clamp(2.0 * robust_sigma(residuals_of(matches)), 0.05 * cell_m, cell_m);
}

double piece_of(const PreparedScan& target, const PreparedScan& source) {
  return std::max(target.piece_m, source.piece_m);
}

Pose refined(const PreparedScan& target, const PreparedScan& source, Pose pose, const HeldDirections& held,
             const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress,
             std::span<const Stretch> apart) {
  const double fine_m = piece_of(target, source);
  if (options.refinement == Refinement::points) {
    const IcpTarget points(icp_cloud(target.surface(fine_m)), options.icp);
    const IcpResult found = icp_align(points, icp_cloud(source.surface(fine_m)), pose, options.icp, progress);
    return held_at(pose, found.target_from_source, held, axes);
  }
  const double coarse_m = 2.0 * fine_m;
  pose = stepped_to_rest(target.surface(coarse_m), source.surface(coarse_m), pose, held, axes, apart, 0.5 * coarse_m,
                         2e-4, progress);
  return stepped_to_rest(target.surface(fine_m), source.surface(fine_m), pose, held, axes, apart, 0.0, 5e-5, progress);
}

Pose refined_from_large(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                        const HeldDirections& held, const Eigen::Matrix3d& axes, const RegistrationOptions& options,
                        Progress& progress) {
  const double large_m = 4.0 * piece_of(target, source);
  const Pose large = stepped_to_rest(target.surface(large_m), source.surface(large_m), target_from_source, held, axes,
                                     {}, 0.5 * large_m, 2e-4, progress);
  return refined(target, source, large, held, axes, options, progress);
}

std::optional<Pose> one_step(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const HeldDirections& held, const Eigen::Matrix3d& axes, std::span<const Stretch> apart,
                             Progress& progress) {
  const double size_m = piece_of(target, source);
  const auto step =
      step_of(target.surface(size_m), source.surface(size_m), target_from_source, held, axes, apart, 0.0, progress);
  if (!step) return std::nullopt;
  return stepped(target_from_source, *step);
}

std::vector<SurfaceMatch> outside(std::span<const Stretch> apart, std::vector<SurfaceMatch> matches,
                                  const Pose& target_from_source, const Eigen::Matrix3d& axes) {
  if (!apart.empty())
    std::erase_if(matches, [&](const SurfaceMatch& match) {
      return is_in(axes.row(0).dot(target_from_source.translation() + match.arm), apart);
    });
  return matches;
}

}  // namespace adit
