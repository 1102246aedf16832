#include "core/registration/register_pair.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"
#include "core/registration/ndt.h"
#include "core/registration/observability.h"

namespace adit {
namespace {

/// Reach of Tukey's weights for the noise found in the overlap: 4.685 sigma keeps 95 % of the efficiency on normal
/// noise.
double tukey_reach_m(const NormalEquations& equations, double match_distance_m) {
  return std::clamp(4.685 * robust_sigma(equations.residuals_m), 0.02, 0.5 * match_distance_m);
}

/// Robust Gauss-Newton steps until they are too small to matter, 20 at most.
Pose stepped_to_rest(const PreparedScan& target, const PreparedScan& source, Pose pose, double match_distance_m,
                     double tukey_m, Progress& progress) {
  for (int iteration = 0; iteration < 20; ++iteration) {
    progress.check();
    const NormalEquations equations =
        point_to_plane_equations(target, source, pose, match_distance_m, tukey_m, progress);
    if (equations.weight < 50.0) return pose;
    const Matrix6d damped = equations.hessian + 1e-6 * equations.weight * Matrix6d::Identity();
    const Vector6d step = -damped.ldlt().solve(equations.gradient);
    pose = stepped(pose, step);
    if (step.head<3>().norm() < 2e-6 && step.tail<3>().norm() < 2e-5) break;
  }
  return pose;
}

/// First with a wide reach, then with the reach that fits the noise.
Pose polished(const PreparedScan& target, const PreparedScan& source, Pose pose, double match_distance_m,
              Progress& progress) {
  for (const double share : {0.5, 0.25})
    pose = stepped_to_rest(target, source, pose, match_distance_m, share * match_distance_m, progress);
  const NormalEquations found =
      point_to_plane_equations(target, source, pose, match_distance_m, 0.25 * match_distance_m, progress);
  return stepped_to_rest(target, source, pose, match_distance_m, tukey_reach_m(found, match_distance_m), progress);
}

void put_back_to_guess(Pose& pose, const Pose& guess, const std::vector<Eigen::Vector3d>& axes) {
  for (const auto& axis : axes) pose.translation() -= axis * axis.dot(pose.translation() - guess.translation());
}

double share_below(const std::vector<double>& values, double limit) {
  if (values.empty()) return 0.0;
  const auto n = std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v) < limit; });
  return static_cast<double>(n) / static_cast<double>(values.size());
}

void judge(PairResult& pair, const PreparedScan& target, const PreparedScan& source, const Pose& guess,
           const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress) {
  const auto equations_at = [&](double tukey_m) {
    return point_to_plane_equations(target, source, pair.target_from_source, options.match_distance_m, tukey_m,
                                    progress);
  };
  const double tukey_m = tukey_reach_m(equations_at(0.25 * options.match_distance_m), options.match_distance_m);
  NormalEquations equations = equations_at(tukey_m);
  const double noise = std::max(options.point_sigma_m, robust_sigma(equations.residuals_m));
  const PairInformation known =
      judge_observability(equations, noise, source.spacing_m, axes, options.undetermined_sigma_m);
  pair.sigma = known.sigma;
  pair.undetermined = known.undetermined;
  pair.information = known.information;
  if (!known.undetermined_axes.empty()) {
    put_back_to_guess(pair.target_from_source, guess, known.undetermined_axes);
    equations = equations_at(tukey_m);
  }
  std::vector<double> sizes;
  for (const double r : equations.residuals_m) sizes.push_back(std::abs(r));
  pair.median_m = median(sizes);
  pair.rms_m = root_mean_square(equations.residuals_m);
  pair.median_distance_m = median(equations.distances_m);
  pair.within_6mm = share_below(equations.residuals_m, 0.006);
  pair.overlap =
      overlap_at(target, source, pair.target_from_source, 2.0 * std::max(target.spacing_m, source.spacing_m));
}

}  // namespace

double overlap_at(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                  double distance_m) {
  const std::size_t near =
      parallel_ordered_sum(source.points.size(), 4096, std::size_t{0}, [&](std::size_t begin, std::size_t end) {
        std::size_t count = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const Eigen::Vector3d q = target_from_source * source.points[i].cast<double>();
          if (target.tree->nearest_within(q.cast<float>(), distance_m)) ++count;
        }
        return count;
      });
  return static_cast<double>(near) / static_cast<double>(std::max<std::size_t>(1, source.points.size()));
}

PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                         Progress& progress) {
  PairResult pair;
  pair.source = source.name;
  pair.target = target.name;
  NdtOptions ndt;
  ndt.coarsest_cell_m = options.cell_m;
  Progress transform = progress.part(0.7, "");
  const Pose pose = ndt_align(target.pyramid, source.pyramid, guess, ndt, transform).target_from_source;
  Progress last = progress.part(0.3, "");
  pair.target_from_source = polished(target, source, pose, options.match_distance_m, last);
  judge(pair, target, source, guess, tunnel_axes(axis_in_target), options, last);
  return pair;
}

}  // namespace adit
