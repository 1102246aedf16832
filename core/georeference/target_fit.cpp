#include "core/georeference/target_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"
#include "core/georeference/target_adjustment.h"
#include "core/georeference/target_decode.h"

namespace adit {
namespace {

using coded_pattern::segments;

constexpr double places_across = 26.0, places_across_search = 18.0;
constexpr double least_soft_likeness = 0.90, sure_likeness = 0.965, hopeless_likeness = 0.85;
constexpr double least_likeness = 0.96, least_likeness_covered = 0.983;
// What noise does not explain (unexplained_share), measured: right targets leave up to 0.028, but for single ones, the
// likest letters and bolts 0.027 and more.
constexpr double most_unexplained = 0.027;
// Black creeps over white in ink that runs, white over black by light and gamma: right targets show -0.3 to 0.7.
constexpr double least_bleed = -0.5, most_bleed = 0.75;
// Of overexposed paper up to 0.9, beside a likeness of 0.996 and 0.005 that is not explained: no letters come near.
constexpr double most_bleed_overexposed = 1.2, sure_of_all_likeness = 0.99, sure_of_all_unexplained = 0.01;
// Shares of places that must lie near the fitted pattern. What is no target, or another code, leaves more of them.
constexpr double least_soft_near = 0.70, least_disc_near = 0.93;
constexpr double least_disc_near_covered = 0.98;
constexpr double least_near_of_any = 0.97, least_near_of_known = 0.80;

/// Before the code is known: place and darkness of the segments by turns. The rims of the ring hold the scale, which
/// the disc of a small target, blurred as it is, leaves open.
bool refine_with_any_segments(FitProblem& problem, Appearance& look, int turns) {
  constexpr int steps = 1;
  constexpr double least_after_a_turn = 0.84;  // right ones: 0.857 and more
  FitSums last;
  for (int turn = 0; turn < turns; ++turn) {
    const auto darkness =
        segment_darkness(*problem.picture, look.place, problem.grid, {look.blur_px, look.bleed, look.black});
    if (!darkness) return false;
    for (std::size_t k = 0; k < problem.blackness.size(); ++k)
      problem.blackness[k] = std::clamp(darkness->value[k], 0.0, 1.0);
    if (look.black < least_amplitude || !refine(problem, look, outlier_limit(look), steps, last)) return false;
    if (turn + 1 < turns && quality_of(problem, look).likeness < least_after_a_turn) return false;
  }
  return look.black >= least_amplitude;
}

/// Perspective that the shape permits, but for its sign (weak perspective cannot tell).
Eigen::Vector2d possible_tilt(const Eigen::Matrix2d& shape, double focal_px) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(shape, Eigen::ComputeFullV);
  const double longer = svd.singularValues()(0), shorter = svd.singularValues()(1);
  const double sine = std::sqrt(std::max(0.0, 1.0 - std::pow(shorter / longer, 2)));
  return longer / focal_px * sine * svd.matrixV().col(1);
}

/// All of a pattern whose code is not known yet.
struct Whole {
  FitProblem problem;
  Appearance look;
  double likeness = 0.0;
};

std::optional<Whole> fit_whole(const GreyPicture& picture, const TargetStart& core, const Eigen::Vector2d& tilt,
                               double tilt_sigma) {
  constexpr int turns = 2;
  const double radius_px = long_radius_px(core.place.shape);
  Whole whole{
      {&picture, pattern_grid(0.0, whole_radius, radius_px, places_across_search), true, {}, false, tilt, tilt_sigma},
      {},
      0.0};
  whole.look.place = core.place;
  whole.look.blur_px = core.blur_px;
  set_levels(disc_problem(picture, core.place), whole.look);
  whole.look.place.tilt = tilt;
  if (!refine_with_any_segments(whole.problem, whole.look, turns)) return std::nullopt;
  const FitQuality quality = quality_of(whole.problem, whole.look);
  if (quality.near < least_soft_near || quality.core_near < least_core_near) return std::nullopt;
  whole.likeness = quality.likeness;
  return whole;
}

/// With the perspective that fits best: none, or that of a circle tilted to either side.
std::optional<Whole> best_whole(const GreyPicture& picture, const TargetStart& core, double focal_px) {
  constexpr double no_tilt = 0.02;
  const Eigen::Vector2d tilt = possible_tilt(core.place.shape, focal_px);
  const double sigma = 0.3 * long_radius_px(core.place.shape) / focal_px + 1e-3;
  const std::array<Eigen::Vector2d, 3> sides = {Eigen::Vector2d::Zero(), tilt, -tilt};
  if (tilt.norm() < no_tilt) return fit_whole(picture, core, sides[0], sigma);
  std::optional<Whole> best;
  for (const Eigen::Vector2d& side : sides) {
    auto whole = fit_whole(picture, core, side, sigma);
    if (whole && (!best || whole->likeness > best->likeness)) best = std::move(whole);
  }
  return best;
}

/// True when three quarters of the disc are black and the one that should be is white. Rings and discs of other things
/// have no such quarter.
bool shows_the_quarter(const FitProblem& problem, const Appearance& look, bool may_be_covered) {
  constexpr double most_white = 0.3, sure_black = 0.65, covered_black = 0.4;
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  Eigen::Matrix<double, 5, 5> normal = 1e-6 * Eigen::Matrix<double, 5, 5>::Identity();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  for (const PatternPlace& place : problem.grid) {
    if (place.radius > core_radius) continue;
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) return false;
    const std::array<double, 4> quarters = quarters_at(place, blur);
    Eigen::Matrix<double, 5, 1> row;
    row << -look.black * quarters[0], -look.black * quarters[1], -look.black * quarters[2], -look.black * quarters[3],
        1.0;
    normal += row * row.transpose();
    right += row * (problem.picture->between(pixel.x(), pixel.y()) - look.white_slope.dot(place.at));
  }
  const Eigen::Matrix<double, 5, 1> dark = normal.ldlt().solve(right);
  int black = 0;
  bool none_white = true;
  for (int k = 1; k < 4; ++k) {
    black += dark(k) > sure_black ? 1 : 0;
    none_white = none_white && dark(k) > covered_black;
  }
  return dark(0) < most_white && none_white && black >= (may_be_covered ? 2 : 3);
}

/// What hides parts of a target in the paper's own colour, or the ring's, pulls it and weighs as much as the rest: by
/// up to 3 % of the radius on covered pictures. Whole targets leave less than 0.001 unexplained.
double pulled_by_cover_px(double unexplained, const TargetPlace& place) {
  constexpr double of_whole = 0.0015, of_radius = 0.18;
  return of_radius * long_radius_px(place.shape) * std::sqrt(std::max(0.0, unexplained - of_whole));
}

Eigen::Matrix2d with_cover(const Eigen::Matrix2d& covariance_px2, double covered_px) {
  return covariance_px2 + covered_px * covered_px * Eigen::Matrix2d::Identity();
}

/// The code, and everything adjusted to it. Nothing where the code does not stay the same.
std::optional<TargetReading> read_whole(FitProblem problem, Appearance look, const std::vector<TargetCode>& codes) {
  constexpr int more_turns = 1, steps = 10, last_steps = 4;
  problem.grid = pattern_grid(0.0, whole_radius, long_radius_px(look.place.shape), places_across);
  const auto decode = [&] {
    return decode_segments(*problem.picture, look.place, problem.grid, {look.blur_px, look.bleed, look.black}, codes);
  };
  auto first = decode();
  if (!first && refine_with_any_segments(problem, look, more_turns)) first = decode();
  if (!first) return std::nullopt;
  for (int k = 0; k < segments; ++k)
    problem.blackness[static_cast<std::size_t>(k)] = is_black(first->code, k) ? 1.0 : 0.0;
  FitSums last;
  if (!refine(problem, look, outlier_limit(look), steps, last) || !last.whole) return std::nullopt;
  const FitQuality quality = quality_of(problem, look);
  const double least_near = first->alone ? least_near_of_any : least_near_of_known;
  // What is covered in part must fit the better elsewhere.
  const bool covered = quality.near < least_near_of_any;
  const double wanted = covered ? least_likeness_covered : least_likeness;
  const double wanted_near = covered ? least_disc_near_covered : least_disc_near;
  if (quality.likeness < wanted || quality.near < least_near || quality.core_near < wanted_near) return std::nullopt;
  const FitProblem uncovered = of_near_places(problem, look);
  if (uncovered.grid.size() < problem.grid.size() && !refine(uncovered, look, outlier_limit(look), last_steps, last))
    return std::nullopt;
  const double unexplained = unexplained_share(problem, look);
  const bool sure_of_all = quality.likeness > sure_of_all_likeness && unexplained < sure_of_all_unexplained;
  if (look.bleed < least_bleed || look.bleed > (sure_of_all ? most_bleed_overexposed : most_bleed) ||
      unexplained > most_unexplained)
    return std::nullopt;
  const double covered_px = pulled_by_cover_px(unexplained, look.place);
  const auto decoded = decode();
  if (!decoded || decoded->code != first->code || decoded->alone != first->alone) return std::nullopt;
  if (!shows_the_quarter(problem, look, !first->alone)) return std::nullopt;
  return TargetReading{
      decoded->code,    look.place,      look.blur_px,   look.bleed,
      quality.likeness, decoded->margin, decoded->alone, with_cover(center_covariance(problem, look, last), covered_px),
      covered_px};
}

}  // namespace

TargetReading finer_reading(const GreyPicture& picture, const TargetReading& reading, double focal_length_px) {
  constexpr double across = 72.0;
  constexpr int steps = 5, every = 9;
  const double radius_px = long_radius_px(reading.place.shape);
  FitProblem problem{&picture, {}, true, {}, false, reading.place.tilt, 0.3 * radius_px / focal_length_px + 1e-3};
  for (int k = 0; k < segments; ++k)
    problem.blackness[static_cast<std::size_t>(k)] = is_black(reading.code, k) ? 1.0 : 0.0;
  Appearance look;
  look.place = reading.place;
  look.blur_px = std::clamp(reading.blur_px, 0.6, 2.0);
  look.bleed = reading.bleed;
  // Wide enough to reach the edges from where they were found.
  const TargetBlur wide(std::max(1.5, 1.5 * reading.blur_px), 0.0, reading.place.shape);
  int inside = 0;
  for (const PatternPlace& place : pattern_grid(0.0, whole_radius, radius_px, across)) {
    const double darkness = shade_of(problem.blackness, place, wide).value;
    if ((darkness > 0.01 && darkness < 0.99) || ++inside % every == 0) problem.grid.push_back(place);
  }
  set_levels(problem, look);
  FitSums last;
  if (look.black < least_amplitude || !refine(problem, look, outlier_limit(look), steps, last) || !last.whole ||
      (look.place.center - reading.place.center).norm() > 0.05 * radius_px)
    return reading;
  TargetReading finer = reading;
  finer.place = look.place;
  finer.blur_px = look.blur_px;
  finer.bleed = look.bleed;
  finer.covariance_px2 = with_cover(center_covariance(problem, look, last), reading.covered_px);
  return finer;
}

bool reflection_on_disc(const GreyPicture& picture, const TargetReading& reading) {
  constexpr double across = 40.0, as_bright_as_can_be = 250.0, black_through = 0.97, most_light = 0.3,
                   most_share = 0.02;
  const FitProblem disc{&picture, pattern_grid(0.0, core_radius, long_radius_px(reading.place.shape), across),
                        false,    {},
                        true,     {0.0, 0.0},
                        1e-3};
  Appearance look;
  look.place = reading.place;
  look.blur_px = reading.blur_px;
  look.bleed = reading.bleed;
  set_levels(disc, look);
  if (look.white < as_bright_as_can_be) return false;
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  double black = 0.0, light = 0.0;
  for (const PatternPlace& place : disc.grid) {
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!picture.holds(pixel.x(), pixel.y()) || disc_shade_at(place, blur).value < black_through) continue;
    black += 1.0;
    light += picture.between(pixel.x(), pixel.y()) > look.white - look.black * (1.0 - most_light) ? 1.0 : 0.0;
  }
  return light > most_share * black;
}

std::optional<TargetReading> read_target(const GreyPicture& picture, const TargetStart& start,
                                         const TargetFitOptions& options) {
  constexpr double small_px = 14.0, larger = 1.2;
  constexpr double least_radius_px = 6.0;  // of the disc's fit; what was read began with 6.6 and more
  if (start.likeness < 0.0) return std::nullopt;
  const double focal_px =
      options.focal_length_px > 0.0 ? options.focal_length_px : std::max(picture.width, picture.height);
  std::optional<Whole> unsure;
  // A sure one is read at once, the best of the others last.
  const auto reading_of = [&](const TargetStart& core) -> std::optional<TargetReading> {
    if (core.likeness < 0.0 || long_radius_px(core.place.shape) < least_radius_px) return std::nullopt;
    auto whole = best_whole(picture, core, focal_px);
    if (!whole) return std::nullopt;
    if (whole->likeness > sure_likeness)
      if (auto reading = read_whole(whole->problem, whole->look, options.codes)) return reading;
    if (!unsure || whole->likeness > unsure->likeness) unsure = std::move(whole);
    return std::nullopt;
  };
  if (auto reading = reading_of(start)) return reading;
  if (auto reading = reading_of(softer_start(picture, start))) return reading;
  // Blur and bleeding leave open how large a small disc is: where it nearly fits, a larger one may.
  if (long_radius_px(start.place.shape) <= small_px && unsure && unsure->likeness >= hopeless_likeness) {
    TargetStart grown = start;
    grown.place.shape *= larger;
    if (auto reading = reading_of(grown)) return reading;
  }
  if (!unsure || unsure->likeness < least_soft_likeness || unsure->likeness > sure_likeness) return std::nullopt;
  return read_whole(unsure->problem, unsure->look, options.codes);
}

}  // namespace adit
