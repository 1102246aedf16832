#include "core/registration/pair_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"
#include "core/registration/fit_check.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/scale_check.h"

namespace adit {
namespace {

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

ScaleCheck scale_of(std::span<const SurfaceMatch> matches, double piece_m) {
  return check_scale(matches, tukey_reach_m(matches, piece_m));
}

/// Where scans bend, in a real room and a real corridor, scales of 0.5 to 2 per mille come out between scans of one
/// scanner: of pairs with other answers no scale is known better than that, nor than these answers agree on it.
void measure_scale(PairResult& pair, const PreparedScan& target, const PreparedScan& source,
                   std::span<const SurfaceMatch> matches, std::span<const Pose> other_answers, Progress& progress) {
  const double piece_m = piece_of(target, source);
  const SurfaceMap& surface = target.surface(piece_m);
  const ScaleCheck check = scale_of(matches, piece_m);
  pair.scale = check.scale;
  pair.scale_sigma = check.sigma;
  if (check.sigma == 0.0 || other_answers.empty()) return;
  constexpr double bent_scale = 1e-3;
  pair.scale_sigma = std::hypot(pair.scale_sigma, bent_scale);
  for (const Pose& other : other_answers) {
    const ScaleCheck there =
        scale_of(surface_matches(surface, source.surface(surface.cell_m()), other, progress), piece_m);
    pair.scale_sigma = std::hypot(pair.scale_sigma, there.scale - check.scale);
  }
}

void measure_fit(PairResult& pair, const PreparedScan& target, const PreparedScan& source) {
  const FitCheck check = check_fit(target, source, pair.target_from_source);
  pair.agreeing = check.agreeing;
  if (target.noise_m > 0.0 && source.noise_m > 0.0) pair.noise_m = std::max(target.noise_m, source.noise_m);
  pair.seen_through = check.seen_through;
  pair.overlap = overlap_at(target, source, pair.target_from_source, 0.4);
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

void fill_sheet(PairResult& pair, const PreparedScan& target, const PreparedScan& source,
                std::span<const SurfaceMatch> matches, std::span<const Pose> other_answers, const Eigen::Matrix3d& axes,
                Progress& progress) {
  const std::array<std::function<void()>, 3> parts{
      [&] { measure(pair, matches, axes); },
      [&] { measure_scale(pair, target, source, matches, other_answers, progress); },
      [&] { measure_fit(pair, target, source); }};
  parallel_for_each_index(
      parts.size(), [&](std::size_t i) { parts[i](); }, 1);
}

}  // namespace adit
