#include "core/registration/witness.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/statistics.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/slope_likeness.h"

namespace adit {
namespace {

/// Stretches that hold all pieces but a twentieth at either end.
std::size_t overlap_of(const SlopesAlong& slopes) {
  const double all = slopes.all().pieces;
  double seen = 0.0;
  std::size_t overlap = 0;
  for (const Slopes& stretch : slopes.stretches) {
    seen += stretch.pieces;
    if (seen > 0.05 * all && seen - stretch.pieces < 0.95 * all) ++overlap;
  }
  return overlap;
}

std::size_t strongest(const SlopesAlong& slopes, std::size_t many) {
  std::size_t best = 0;
  for (std::size_t first = 1; first + many <= SlopesAlong::count; ++first)
    if (slopes.of(first, many).common > slopes.of(best, many).common) best = first;
  return best;
}

bool is_apart(std::size_t stretch, std::span<const Stretch> apart) {
  return is_in(SlopesAlong::begin_m(stretch) + 0.5 * SlopesAlong::length_m, apart);
}

SlopesAlong outside(std::span<const Stretch> apart, SlopesAlong slopes) {
  for (std::size_t i = 0; i < SlopesAlong::count; ++i)
    if (is_apart(i, apart)) slopes.stretches[i] = {};
  return slopes;
}

/// How alike the stretches are, each by itself and weighed by its pieces: a machine or a face slopes more than all of
/// the rock, but stands in few of them.
double votes(const SlopesAlong& slopes, std::span<const Stretch> apart) {
  double sum = 0.0, pieces = 0.0;
  for (std::size_t i = 0; i < SlopesAlong::count; ++i) {
    if (is_apart(i, apart)) continue;
    const Slopes& stretch = slopes.stretches[i];
    sum += stretch.pieces * std::clamp(stretch.likeness(), -1.0, 1.0);
    pieces += stretch.pieces;
  }
  return sum / std::max(1.0, pieces);
}

/// With the pair so far on along the axis, on the finest pieces.
SlopesAlong slopes_farther_on(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                              const Eigen::Vector3d& axis, double shift_m, double near_m, std::size_t enough,
                              Progress& progress) {
  progress.check();
  const double size_m = piece_of(target, source);
  const Pose moved = Eigen::Translation3d(shift_m * axis) * target_from_source;
  return slopes_along(target.surface(size_m), source.surface(size_m), moved, axis, near_m, enough);
}

}  // namespace

WitnessSlopes witness_slopes(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const Eigen::Vector3d& axis, double near_m, Progress& progress) {
  constexpr double beside_m = 0.35;
  const auto slopes_at = [&](double shift_m) {
    return slopes_farther_on(target, source, target_from_source, axis, shift_m, near_m, enough_slopes, progress);
  };
  return {slopes_at(0.0), slopes_at(-beside_m), slopes_at(beside_m)};
}

Witness strongest_witness(const WitnessSlopes& slopes, std::span<const Stretch> apart) {
  constexpr double longest_m = 4.0;
  const SlopesAlong here = outside(apart, slopes.here);
  const auto longest = static_cast<std::size_t>(longest_m / SlopesAlong::length_m);
  const std::size_t many = std::clamp<std::size_t>(overlap_of(here) / 3, 1, longest);
  const std::size_t first = strongest(here, many);
  const auto of_rest = [&](const SlopesAlong& all) {
    Slopes rest = all.all();
    rest -= all.of(first, many);
    return rest.likeness();
  };
  const double beside =
      std::max(0.0, 0.5 * (of_rest(outside(apart, slopes.before)) + of_rest(outside(apart, slopes.behind))));
  Witness witness;
  witness.stretch = {SlopesAlong::begin_m(first), SlopesAlong::begin_m(first + many)};
  witness.share = here.of(first, many).common / std::max(here.all().common, 1e-9);
  witness.borne_out = of_rest(here) - beside >= least_likeness;
  return witness;
}

double likelier_shift_m(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                        const Eigen::Vector3d& axis, double from_m, double to_m, std::span<const Stretch> apart,
                        Progress& progress) {
  constexpr double step_m = 0.1, wide_m = 0.05, same_place_m = 0.15;
  constexpr double least = 0.1, clearly = 2.0;  // times as alike
  constexpr std::size_t enough_pieces = 6000;
  const auto votes_for = [&](double shift_m) {
    return votes(slopes_farther_on(target, source, target_from_source, axis, shift_m, wide_m, enough_pieces, progress),
                 apart);
  };
  std::vector<double> all;
  double best_m = 0.0, most = 0.0;
  for (double shift_m = from_m; shift_m <= to_m; shift_m += step_m) {
    all.push_back(votes_for(shift_m));
    if (std::abs(shift_m) > same_place_m && all.back() > most) best_m = shift_m, most = all.back();
  }
  if (all.empty()) return 0.0;
  const double anywhere = std::max(0.0, median(all));  // bends and grade
  const double here = std::max(0.0, votes_for(0.0) - anywhere);
  return most - anywhere >= std::max(least, clearly * here) ? best_m : 0.0;
}

}  // namespace adit
