#include "core/registration/ndt.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <utility>
#include <vector>

#include "core/registration/ndt_score.h"
#include "core/registration/newton.h"

namespace adit {
namespace {

/// Steps that matter in cells of this size; those of the last decide about tenths of a millimetre.
NewtonOptions newton_options(double cell_m, bool last, const NdtOptions& options) {
  constexpr double share = 0.01;
  NewtonOptions newton;
  newton.most_iterations = options.most_iterations;
  newton.held_direction = options.held_direction;
  newton.longest_step_m = 0.5 * cell_m;
  newton.least_step_m = last ? 1e-5 : share * cell_m;
  return newton;
}

/// The translation that changes the score least, when the rotation follows (Schur complement).
Eigen::Vector3d weakest_direction(const Matrix6d& hessian) {
  const Eigen::Matrix3d turn = hessian.topLeftCorner<3, 3>() + 1e-9 * hessian.norm() * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d shift = hessian.bottomRightCorner<3, 3>() -
                                hessian.bottomLeftCorner<3, 3>() * turn.ldlt().solve(hessian.topRightCorner<3, 3>());
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(shift).eigenvectors().col(0);
}

/// The second must be clearly better: where the tunnel tells nothing along itself, the guess stands.
const NewtonResult& better(const NewtonResult& first, const NewtonResult& second) {
  constexpr double clearly = 1.02;
  return second.at.score < clearly * first.at.score ? second : first;
}

/// The best of the starts along the weakest direction, nearest first.
template <typename Descend>
NewtonResult best_along(const NewtonResult& first, double search_m, const Descend& descended) {
  constexpr double start_spacing_m = 2.0;
  const Eigen::Vector3d direction = weakest_direction(first.at.hessian);
  NewtonResult best = first;
  for (double away_m = start_spacing_m; away_m <= search_m; away_m += start_spacing_m)
    for (const double side : {-1.0, 1.0}) {
      Pose start = first.pose;
      start.translation() += side * away_m * direction;
      best = better(best, descended(start));
    }
  return best;
}

std::vector<NormalDistribution> as_points(const DistributionMap& cells) {
  std::vector<NormalDistribution> points(cells.distributions().size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i].mean = cells.distributions()[i].mean;
  return points;
}

}  // namespace

NdtAlignment ndt_align(const DistributionPyramid& target, const DistributionPyramid& source, const Pose& guess,
                       const NdtOptions& options, Progress& progress) {
  NdtAlignment result;
  std::vector<Pose> starts{guess};
  std::vector<NormalDistribution> points;
  if (options.sources == NdtSources::points) points = as_points(source.levels.front());
  const std::size_t finest = target.level_near(options.finest_cell_m, 1);
  const std::size_t coarsest = target.level_near(options.coarsest_cell_m, finest);
  for (std::size_t level = coarsest + 1; level-- > finest;) {
    progress.step(coarsest - level, coarsest - finest + 1);
    const DistributionMap& cells = target.levels[level];
    const auto& sources = options.sources == NdtSources::points
                              ? points
                              : source.levels[source.level_near(0.5 * cells.cell_m())].distributions();
    const auto score = [&](const Pose& at) { return ndt_score(cells, sources, at, options.score, progress); };
    const auto descended = [&](const Pose& start) {
      NewtonResult found = descend(start, score, newton_options(cells.cell_m(), level == finest, options));
      result.iterations += found.iterations;
      return found;
    };
    NewtonResult found = descended(starts.front());
    for (std::size_t i = 1; i < starts.size(); ++i) found = better(found, descended(starts[i]));
    starts = {found.pose};
    if (level == coarsest) {
      NewtonResult along = best_along(found, options.search_m, descended);
      if (level > finest)
        starts.push_back(along.pose);  // the next cells choose
      else
        found = std::move(along);
    }
    result.target_from_source = found.pose;
    result.score = found.at.weight > 0.0 ? found.at.score / found.at.weight : 0.0;
  }
  return result;
}

}  // namespace adit
