#include "core/registration/register_pair.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"
#include "core/registration/fit_check.h"
#include "core/registration/icp.h"
#include "core/registration/ndt.h"

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

/// Reach of Tukey's weights, for the noise found in the overlap. A wider one (4.685 sigma) would use clean noise a
/// little better, but where a scanner bends the walls, as real ones do, it averages what does not belong together: on
/// the real corridor the pairs then leave a loop 0.16 m open instead of 0.03 m.
double tukey_reach_m(std::span<const SurfaceMatch> matches, double cell_m) {
  return std::clamp(2.0 * robust_sigma(residuals_of(matches)), 0.05 * cell_m, cell_m);
}

constexpr std::size_t least_matches = 50;

/// Both scans are to hold enough points in a piece.
double piece_of(const PreparedScan& target, const PreparedScan& source) {
  return std::max(target.piece_m, source.piece_m);
}

/// least_reach_m: of Tukey's weights, however little the noise.
std::optional<Vector6d> step_of(const SurfaceMap& target, const SurfaceMap& source, const Pose& pose,
                                const HeldDirections& held, const Eigen::Matrix3d& axes, double least_reach_m,
                                Progress& progress) {
  const std::vector<SurfaceMatch> matches = surface_matches(target, source.pieces(), pose, progress);
  if (matches.size() < least_matches) return std::nullopt;
  const double reach_m = std::max(least_reach_m, tukey_reach_m(matches, target.cell_m()));
  const NormalEquations equations = normal_equations(matches, reach_m);
  // Far matches pull less the farther they are: the cost bends less than the weights say, and the steps would be short.
  const double bend = std::clamp(equations.curvature / std::max(equations.weight, 1e-9), 0.4, 1.0);
  return Vector6d(step_without(equations, held, axes) / bend);
}

/// The reach is first_reach_m, then half of it, and so on down to what the noise asks for: walls that fit already would
/// otherwise shut out a floor that does not yet.
Pose stepped_to_rest(const SurfaceMap& target, const SurfaceMap& source, Pose pose, const HeldDirections& held,
                     const Eigen::Matrix3d& axes, double first_reach_m, double least_step_m, Progress& progress) {
  constexpr int most_steps = 15;
  constexpr double lever_m = 5.0;
  constexpr double least_reach_m = 0.005;
  constexpr double reach_falls = 0.3;
  double reach_m = first_reach_m;
  for (int i = 0; i < most_steps; ++i, reach_m *= reach_falls) {
    const auto step = step_of(target, source, pose, held, axes, reach_m, progress);
    if (!step) break;
    pose = stepped(pose, *step);
    if (reach_m < least_reach_m && step->tail<3>().norm() + lever_m * step->head<3>().norm() < least_step_m) break;
  }
  return pose;
}

/// A pose, judged by the surfaces that meet there.
struct Judged {
  std::vector<SurfaceMatch> matches;
  PairInformation known;
};
Judged judge(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const Eigen::Matrix3d& axes,
             const HeldDirections& held, const RegistrationOptions& options, Progress& progress) {
  const SurfaceMap& surface = target.surface(piece_of(target, source));
  Judged judged;
  judged.matches = surface_matches(surface, source.surface(surface.cell_m()).pieces(), pose, progress);
  judged.known = judge_observability(judged.matches, tukey_reach_m(judged.matches, surface.cell_m()), axes,
                                     {options.undetermined_sigma_m, options.pair_sigma_m}, held);
  return judged;
}

/// What is held stands at the guess.
PoseSigma no_worse_than_guess(const PoseSigma& sigma, const RegistrationOptions& options) {
  const double most_m = options.guess_sigma_m;
  const double most_rad = rad_from_deg(options.guess_sigma_deg);
  return {std::min(sigma.along_m, most_m),    std::min(sigma.across_m, most_m),    std::min(sigma.up_m, most_m),
          std::min(sigma.roll_rad, most_rad), std::min(sigma.pitch_rad, most_rad), std::min(sigma.yaw_rad, most_rad)};
}

void measure(PairResult& pair, std::span<const SurfaceMatch> matches, const Eigen::Matrix3d& axes) {
  std::vector<double> sizes, distances;
  std::size_t within = 0;
  double squares = 0.0;
  for (const SurfaceMatch& match : matches) {
    sizes.push_back(std::abs(match.residual_m));
    distances.push_back(match.distance_m);
    if (sizes.back() < 0.006) ++within;
    squares += match.residual_m * match.residual_m;
    pair.balance += (axes * match.normal).cwiseAbs2();
  }
  if (matches.empty()) return;
  const auto n = static_cast<double>(matches.size());
  pair.median_m = median(sizes);
  pair.rms_m = std::sqrt(squares / n);
  pair.median_distance_m = median(distances);
  pair.within_6mm = static_cast<double>(within) / n;
  pair.balance /= n;
}

}  // namespace

double overlap_at(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                  double distance_m) {
  const auto& pieces = source.surfaces.back().pieces();
  const DistributionMap& cells = target.pyramid.levels[target.pyramid.level_near(distance_m)];
  const double squared_m2 = distance_m * distance_m;
  const std::size_t near =
      parallel_ordered_sum(pieces.size(), 4096, std::size_t{0}, [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const Eigen::Vector3d place = target_from_source * pieces[i].place.cast<double>();
          bool found = false;
          cells.visit_near(place, [&](const NormalDistribution& cell) {
            found = found || (cell.mean - place).squaredNorm() <= squared_m2;
          });
          if (found) ++count;
        }
        return count;
      });
  return static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(1, pieces.size()));
}

Pose refined(const PreparedScan& target, const PreparedScan& source, Pose pose, const HeldDirections& held,
             const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress) {
  const double fine_m = piece_of(target, source);
  if (options.refinement == Refinement::points) {
    const IcpTarget points(icp_cloud(target.surface(fine_m)), options.icp);
    const IcpResult found = icp_align(points, icp_cloud(source.surface(fine_m)), pose, options.icp, progress);
    return held_at(pose, found.target_from_source, held, axes);
  }
  const double coarse_m = 2.0 * fine_m;
  pose = stepped_to_rest(target.surface(coarse_m), source.surface(coarse_m), pose, held, axes, 0.5 * coarse_m, 2e-4,
                         progress);
  return stepped_to_rest(target.surface(fine_m), source.surface(fine_m), pose, held, axes, 0.0, 5e-5, progress);
}

std::optional<Pose> one_step(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const HeldDirections& held, const Eigen::Matrix3d& axes, Progress& progress) {
  const double size_m = piece_of(target, source);
  const auto step =
      step_of(target.surface(size_m), source.surface(size_m), target_from_source, held, axes, 0.0, progress);
  if (!step) return std::nullopt;
  return stepped(target_from_source, *step);
}

PairInformation pair_information(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                                 const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                                 Progress& progress) {
  return judge(target, source, target_from_source, tunnel_axes(axis_in_target), {}, options, progress).known;
}

PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                         Progress& progress) {
  PairResult pair;
  pair.source = source.name;
  pair.target = target.name;
  const Eigen::Matrix3d axes = tunnel_axes(axis_in_target);
  Progress transform = progress.part(0.5, "");
  NdtOptions ndt;
  ndt.coarsest_cell_m = options.cell_m;
  ndt.finest_cell_m = std::max(ndt.finest_cell_m, 8.0 * piece_of(target, source));
  ndt.sources = options.ndt_sources;
  const double search_m = std::exchange(ndt.search_m, 0.0);
  Progress last = progress.part(0.5, "");
  Pose pose = guess;
  const auto align = [&] {
    const NdtAlignment alignment = ndt_align(target.pyramid, source.pyramid, guess, ndt, transform);
    pair.iterations += alignment.iterations;
    return refined(target, source, alignment.target_from_source, {}, axes, options, last);
  };
  if (start == Start::found) {
    pose = refined(target, source, guess, {}, axes, options, last);
  } else {
    pose = align();
    ndt.search_m = search_m;
    if (!check_fit(target, source, pose).agrees()) pose = align();  // another round of blasting, perhaps
  }
  Judged judged = judge(target, source, pose, axes, {}, options, last);
  const HeldDirections held = judged.known.undetermined;
  if (held != HeldDirections{}) {
    pose = refined(target, source, held_at(guess, pose, held, axes), held, axes, options, last);
    judged = judge(target, source, pose, axes, held, options, last);
  }
  pair.target_from_source = pose;
  pair.sigma = no_worse_than_guess(judged.known.sigma, options);
  pair.information = judged.known.information;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (judged.known.undetermined[i]) pair.undetermined.emplace_back(direction_names[i]);
  measure(pair, judged.matches, axes);
  pair.overlap = overlap_at(target, source, pose, 0.4);
  const FitCheck check = check_fit(target, source, pose);
  pair.agreeing = check.agreeing;
  pair.seen_through = check.seen_through;
  return pair;
}

}  // namespace adit
