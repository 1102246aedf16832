#include "core/georeference/target_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"
#include "core/georeference/target_decode.h"
#include "core/georeference/target_model.h"

namespace adit {
namespace {

using coded_pattern::disc_radius;
using coded_pattern::segments;

constexpr double core_radius = 0.60;   // disc and most of the white ring
constexpr double whole_radius = 1.14;  // and some of the paper around
constexpr double places_across = 26.0;
constexpr double usual_blur_px = 0.8, blur_sigma_px = 0.6;  // of cameras in focus, where a target tells little of it
constexpr double bleed_sigma = 0.7;
constexpr double least_core_likeness = 0.93, sure_core_likeness = 0.985;
constexpr double least_soft_likeness = 0.80;
constexpr double least_likeness = 0.95;
// Shares of places that must lie near the fitted pattern. What is no target, or another code, leaves more of them.
constexpr double least_core_near = 0.80, least_soft_near = 0.70, least_disc_near = 0.93;
constexpr double least_near_of_any = 0.97, least_near_of_known = 0.80;
constexpr double least_amplitude = 5.0;  // grey levels between white and black

double long_radius_px(const Eigen::Matrix2d& shape) {
  return Eigen::JacobiSVD<Eigen::Matrix2d>(shape).singularValues()(0);
}

/// Correlation of two lists of numbers.
class Correlation {
 public:
  void add(double a, double b) {
    ++n_;
    a_ += a;
    b_ += b;
    aa_ += a * a;
    bb_ += b * b;
    ab_ += a * b;
  }
  double value() const {
    const double va = aa_ - a_ * a_ / n_, vb = bb_ - b_ * b_ / n_;
    return n_ > 1.0 && va > 0.0 && vb > 0.0 ? (ab_ - a_ * b_ / n_) / std::sqrt(va * vb) : 0.0;
  }

 private:
  double n_ = 0.0, a_ = 0.0, b_ = 0.0, aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// The black three quarters of a disc of radius 1: their centroid, and one over the square root of their covariance.
struct DiscMoments {
  Eigen::Vector2d centroid;
  Eigen::Matrix2d whitening;
  DiscMoments() {
    // Of the white quarter: first moment 1/3 along either axis, second moments pi/16 and 1/8; of the disc pi/4.
    const double area = 0.75 * pi, first = -1.0 / 3.0 / area;
    const double same = (pi / 4.0 - pi / 16.0) / area - first * first, mixed = -1.0 / 8.0 / area - first * first;
    centroid = {first, first};
    Eigen::Matrix2d covariance;
    covariance << same, mixed, mixed, same;
    whitening = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance).operatorInverseSqrt();
  }
};

/// How the picture looks like disc and white ring at a place; `darkness` of each place of the grid.
double likeness_of(const GreyPicture& picture, const TargetPlace& place, const std::vector<PatternPlace>& grid,
                   const std::vector<double>& darkness) {
  Correlation correlation;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const Eigen::Vector2d pixel = place.pixel(grid[i].at);
    if (!picture.holds(pixel.x(), pixel.y())) return -1.0;
    correlation.add(picture.between(pixel.x(), pixel.y()), -darkness[i]);
  }
  return correlation.value();
}

Eigen::RowVector2d gradient_at(const GreyPicture& picture, const Eigen::Vector2d& pixel) {
  const auto value = [&](double du, double dv) { return picture.between(pixel.x() + du, pixel.y() + dv); };
  return {value(0.5, 0.0) - value(-0.5, 0.0), value(0.0, 0.5) - value(0.0, -0.5)};
}

bool holds_with_gradient(const GreyPicture& picture, const Eigen::Vector2d& pixel) {
  return picture.holds(pixel.x() - 0.5, pixel.y() - 0.5) && picture.holds(pixel.x() + 0.5, pixel.y() + 0.5);
}

/// Everything that makes the grey values of a target: place, blur, brightness of the paper (a plane over the pattern)
/// and what black takes away.
struct Appearance {
  TargetPlace place;
  double blur_px = usual_blur_px;
  double bleed = 0.0;
  double white = 0.0;
  Eigen::Vector2d white_slope = Eigen::Vector2d::Zero();
  double black = 0.0;  ///< grey levels below white
};

/// The unknowns, in order: center 2, shape by rows 4, white, black; then tilt 2, blur, slope of the white 2, bleeding.
constexpr int few_unknowns = 8, unknowns = 14;
using Unknowns = Eigen::Matrix<double, unknowns, 1>;
using NormalMatrix = Eigen::Matrix<double, unknowns, unknowns>;

void move(Appearance& look, const Unknowns& by) {
  look.place.center += by.head<2>();
  look.place.shape(0, 0) += by(2);
  look.place.shape(0, 1) += by(3);
  look.place.shape(1, 0) += by(4);
  look.place.shape(1, 1) += by(5);
  look.white += by(6);
  look.black += by(7);
  look.place.tilt += by.segment<2>(8);
  look.blur_px = std::clamp(look.blur_px + by(10), 0.3, 4.0);
  look.white_slope += by.segment<2>(11);
  look.bleed = std::clamp(look.bleed + by(13), -1.5, 2.5);
  // No paper is darker than nothing: of a small disc, blurred, more black and more blur look alike.
  look.black = std::min(look.black, look.white);
}

struct FitSums {
  NormalMatrix normal = NormalMatrix::Zero();  ///< lower half
  Unknowns right = Unknowns::Zero();
  double cost = 0.0;
  double weight = 0.0;
  bool whole = true;  ///< all places lie in the picture
};

/// What is fitted: the grid, the parts of the pattern that count, which unknowns are free.
struct FitProblem {
  const GreyPicture* picture;
  std::vector<PatternPlace> grid;
  bool with_segments;
  Blackness blackness;  ///< of the segments
  bool few;             ///< tilt, blur and slope stay as they are
  Eigen::Vector2d tilt_prior;
  double tilt_sigma;
};

double darkness_of(const FitProblem& problem, const PatternPlace& place, const TargetBlur& blur) {
  return problem.with_segments ? darkness_of(problem.blackness, place, blur) : disc_darkness_at(place, blur);
}

double value_of(const Appearance& look, const Eigen::Vector2d& at, double darkness) {
  return look.white + look.white_slope.dot(at) - look.black * darkness;
}

/// d (grey of the picture - value of the pattern) / d unknowns, but for the blur.
Unknowns row_of(const Appearance& look, const Eigen::Vector2d& at, const Eigen::RowVector2d& gradient,
                double darkness) {
  const double scale = 1.0 / (1.0 + look.place.tilt.dot(at));
  const double along_tilt = -scale * scale * gradient.dot(look.place.shape * at);
  Unknowns row;
  row << gradient(0), gradient(1), gradient(0) * at.x() * scale, gradient(0) * at.y() * scale,
      gradient(1) * at.x() * scale, gradient(1) * at.y() * scale, -1.0, darkness, along_tilt * at.x(),
      along_tilt * at.y(), 0.0, -at.x(), -at.y(), 0.0;
  return row;
}

/// Huber's weights: what lies off by more than `limit` grey levels (a cover, dust, glare) counts less.
FitSums sums_of(const FitProblem& problem, const Appearance& look, double limit) {
  constexpr double blur_change = 0.05, bleed_change = 0.05;
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  const TargetBlur wider(look.blur_px * (1.0 + blur_change), look.bleed, look.place.shape);
  const TargetBlur bled(look.blur_px, look.bleed + bleed_change, look.place.shape);
  FitSums sums;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d& at = place.at;
    const Eigen::Vector2d pixel = look.place.pixel(at);
    if (!holds_with_gradient(*problem.picture, pixel)) {
      sums.whole = false;
      continue;
    }
    const double darkness = darkness_of(problem, place, blur);
    const double off = problem.picture->between(pixel.x(), pixel.y()) - value_of(look, at, darkness);
    const double weight = std::abs(off) > limit ? limit / std::abs(off) : 1.0;
    sums.cost += weight * off * off;
    sums.weight += weight;
    Unknowns row = row_of(look, at, gradient_at(*problem.picture, pixel), darkness);
    if (problem.few) {
      const Eigen::Matrix<double, few_unknowns, 1> few = row.head<few_unknowns>();
      sums.normal.topLeftCorner<few_unknowns, few_unknowns>() += (weight * few) * few.transpose();
      sums.right.head<few_unknowns>() -= weight * off * few;
    } else {
      row(10) = look.black * (darkness_of(problem, place, wider) - darkness) / (blur_change * look.blur_px);
      row(13) = look.black * (darkness_of(problem, place, bled) - darkness) / bleed_change;
      sums.normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      sums.right -= weight * off * row;
    }
  }
  return sums;
}

/// Levels of white and black by least squares at a fixed place.
void set_levels(const FitProblem& problem, Appearance& look) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  double n = 0.0, d = 0.0, dd = 0.0, g = 0.0, dg = 0.0;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d& at = place.at;
    const Eigen::Vector2d pixel = look.place.pixel(at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) continue;
    const double darkness = darkness_of(problem, place, blur), grey = problem.picture->between(pixel.x(), pixel.y());
    n += 1.0;
    d += darkness;
    dd += darkness * darkness;
    g += grey;
    dg += darkness * grey;
  }
  const double det = n * dd - d * d;
  if (det <= 1e-9) return;
  look.black = -(n * dg - d * g) / det;
  look.white = (g + look.black * d) / n;
}

/// The sums with what is known of perspective, as a whole matrix.
NormalMatrix normal_of(const FitProblem& problem, const FitSums& sums) {
  NormalMatrix normal = sums.normal.selfadjointView<Eigen::Lower>();
  const double variance = std::max(1.0, sums.cost / std::max(1.0, sums.weight));
  for (int k = 8; k < 10; ++k) normal(k, k) += variance / (problem.tilt_sigma * problem.tilt_sigma);
  normal(10, 10) += variance / (blur_sigma_px * blur_sigma_px);
  normal(13, 13) += variance / (bleed_sigma * bleed_sigma);
  return normal;
}

/// Gauss-Newton with damping. False where it leaves the picture or the pattern turns inside out.
bool refine(const FitProblem& problem, Appearance& look, double limit, int most_steps, FitSums& last) {
  double damping = 1e-3;
  last = sums_of(problem, look, limit);
  for (int i = 0; i < most_steps; ++i) {
    if (last.weight < 20.0) return false;
    NormalMatrix normal = normal_of(problem, last);
    Unknowns right = last.right;
    const double pull = std::max(1.0, last.cost / last.weight) / (problem.tilt_sigma * problem.tilt_sigma);
    right.segment<2>(8) += pull * (problem.tilt_prior - look.place.tilt);
    const double variance = std::max(1.0, last.cost / last.weight);
    right(10) += variance / (blur_sigma_px * blur_sigma_px) * (usual_blur_px - look.blur_px);
    right(13) -= variance / (bleed_sigma * bleed_sigma) * look.bleed;
    if (problem.few) right.tail<unknowns - few_unknowns>().setZero();
    for (int k = 0; k < unknowns; ++k) normal(k, k) += damping * normal(k, k) + 1e-9;
    const Unknowns by = normal.ldlt().solve(right);
    if (!by.allFinite()) return false;
    Appearance moved = look;
    move(moved, by);
    if (moved.place.shape.determinant() >= 0.0 || moved.place.tilt.norm() > 0.8) return false;
    const FitSums next = sums_of(problem, moved, limit);
    if (next.cost / std::max(1.0, next.weight) <= last.cost / last.weight) {
      const bool small = by.head<2>().norm() < 2e-3 && by.segment<4>(2).norm() < 5e-3;
      look = moved;
      last = next;
      damping = std::max(1e-6, damping * 0.2);
      if (small) break;
    } else {
      damping *= 10.0;
      if (damping > 1e3) break;
    }
  }
  return true;
}

double outlier_limit(const Appearance& look) {
  return std::max(4.0, 0.15 * look.black);
}

/// How well a fitted pattern explains the picture.
struct FitQuality {
  double likeness = 0.0;   ///< correlation, of the places that lie near
  double near = 0.0;       ///< share of the places that lie near (outlier_limit): the rest is covered, or no target
  double core_near = 0.0;  ///< of disc and white ring
};

FitQuality quality_of(const FitProblem& problem, const Appearance& look) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  const double limit = 2.0 * outlier_limit(look);
  Correlation correlation;
  double all = 0.0, near = 0.0, core = 0.0, core_near = 0.0;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) continue;
    const double darkness = darkness_of(problem, place, blur);
    const double grey = problem.picture->between(pixel.x(), pixel.y());
    const bool is_near = std::abs(grey - value_of(look, place.at, darkness)) <= limit;
    const bool in_core = place.radius < core_radius;
    const bool counts = place.radius < 1.04;  // beyond, the paper of small targets ends
    all += counts ? 1.0 : 0.0;
    core += in_core ? 1.0 : 0.0;
    near += is_near && counts ? 1.0 : 0.0;
    core_near += is_near && in_core ? 1.0 : 0.0;
    if (is_near) correlation.add(grey - look.white_slope.dot(place.at), -darkness);
  }
  return {correlation.value(), near / std::max(1.0, all), core_near / std::max(1.0, core)};
}

/// Disc and white ring alone, without perspective, with two blurs to begin with: the better one. Of a small target
/// both, and one of a larger scale: blur and bleeding leave open how large its disc is.
std::vector<Appearance> fit_core(const GreyPicture& picture, const TargetPlace& start) {
  constexpr int steps = 8;
  constexpr double small_px = 14.0, larger = 1.3;
  const double radius_px = long_radius_px(start.shape);
  const FitProblem problem{&picture, pattern_grid(0.0, core_radius, radius_px, 14.0), false, {}, true, {0.0, 0.0},
                           1e-3};
  std::vector<Appearance> fitted;
  double best = 0.0;
  for (const double blur_px : {0.7, 1.3}) {
    Appearance look;
    look.place = start;
    look.blur_px = blur_px;
    set_levels(problem, look);
    FitSums last;
    if (look.black < least_amplitude || !refine(problem, look, 1e9, steps, last)) continue;
    const FitQuality quality = quality_of(problem, look);
    const double likeness = quality.likeness;
    if (look.black < least_amplitude || likeness <= least_core_likeness || quality.near < least_core_near) continue;
    fitted.insert(likeness > best ? fitted.begin() : fitted.end(), look);
    best = std::max(best, likeness);
    if (best > sure_core_likeness && radius_px > small_px) break;
  }
  if (fitted.empty()) return fitted;
  if (radius_px > small_px) {
    fitted.resize(1);
    return fitted;
  }
  fitted.push_back(fitted.front());
  fitted.back().place.shape *= larger;
  return fitted;
}

/// Before the code is known: place and darkness of the segments by turns. The rims of the ring hold the scale, which
/// the disc of a small target, blurred as it is, leaves open.
bool refine_with_any_segments(FitProblem& problem, Appearance& look, int turns) {
  constexpr int steps = 2;
  FitSums last;
  for (int turn = 0; turn < turns; ++turn) {
    const auto darkness = segment_darkness(*problem.picture, look.place, {look.blur_px, look.bleed, look.black});
    if (!darkness) return false;
    for (std::size_t k = 0; k < problem.blackness.size(); ++k)
      problem.blackness[k] = std::clamp(darkness->value[k], 0.0, 1.0);
    if (look.black < least_amplitude || !refine(problem, look, outlier_limit(look), steps, last)) return false;
  }
  return look.black >= least_amplitude;
}

/// Perspective that the shape permits: none, and that of a circle tilted to either side (weak perspective cannot tell).
std::vector<Eigen::Vector2d> possible_tilts(const Eigen::Matrix2d& shape, double focal_px) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(shape, Eigen::ComputeFullV);
  const double longer = svd.singularValues()(0), shorter = svd.singularValues()(1);
  const double sine = std::sqrt(std::max(0.0, 1.0 - std::pow(shorter / longer, 2)));
  const Eigen::Vector2d tilt = longer / focal_px * sine * svd.matrixV().col(1);
  if (tilt.norm() < 0.02) return {Eigen::Vector2d::Zero()};
  return {Eigen::Vector2d::Zero(), tilt, -tilt};
}

/// All of a pattern whose code is not known yet.
struct Whole {
  FitProblem problem;
  Appearance look;
  double likeness = 0.0;
};

std::optional<Whole> fit_whole(const GreyPicture& picture, const Appearance& core, const Eigen::Vector2d& tilt,
                               double focal_px) {
  constexpr int turns = 2;
  const double radius_px = long_radius_px(core.place.shape);
  Whole whole{{&picture,
               pattern_grid(0.0, whole_radius, radius_px, places_across),
               true,
               {},
               false,
               tilt,
               0.3 * radius_px / focal_px + 1e-3},
              core,
              0.0};
  whole.look.place.tilt = tilt;
  if (!refine_with_any_segments(whole.problem, whole.look, turns)) return std::nullopt;
  const FitQuality quality = quality_of(whole.problem, whole.look);
  if (quality.near < least_soft_near || quality.core_near < least_core_near) return std::nullopt;
  whole.likeness = quality.likeness;
  return whole;
}

/// Covariance of the centre. Places closer than pixels are not independent.
Eigen::Matrix2d center_covariance(const FitProblem& problem, const Appearance& look, const FitSums& sums) {
  NormalMatrix normal = normal_of(problem, sums);
  normal.diagonal().array() += 1e-9;
  const double variance = sums.cost / std::max(1.0, sums.weight - unknowns);
  const double pixels = std::abs(look.place.shape.determinant()) * pi * whole_radius * whole_radius;
  const double dense = std::max(1.0, static_cast<double>(problem.grid.size()) / pixels);
  // What the model leaves out (bent edges, the sensor's own light curve, neighbouring places' common noise), measured
  // on simulated pictures: docs/accuracy.md.
  constexpr double model_factor = 2.0, of_radius = 0.0008;
  const double model_px = of_radius * long_radius_px(look.place.shape);
  return (normal.inverse() * (model_factor * model_factor * dense * variance)).topLeftCorner<2, 2>() +
         model_px * model_px * Eigen::Matrix2d::Identity();
}

/// True when three quarters of the disc are black and the one that should be is white. Rings and discs of other things
/// have no such quarter.
bool shows_the_quarter(const FitProblem& problem, const Appearance& look) {
  constexpr double most_white = 0.4, least_black = 0.4;
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
  for (int k = 1; k < 4; ++k) black += dark(k) > least_black ? 1 : 0;
  return dark(0) < most_white && black == 3;
}

/// The code, and everything adjusted to it. Nothing where the code does not stay the same.
std::optional<TargetReading> read_whole(FitProblem problem, Appearance look, const std::vector<TargetCode>& codes) {
  constexpr int more_turns = 2, steps = 10;
  if (!refine_with_any_segments(problem, look, more_turns)) return std::nullopt;
  const auto first = decode_segments(*problem.picture, look.place, {look.blur_px, look.bleed, look.black}, codes);
  if (!first) return std::nullopt;
  for (int k = 0; k < segments; ++k)
    problem.blackness[static_cast<std::size_t>(k)] = is_black(first->code, k) ? 1.0 : 0.0;
  FitSums last;
  if (!refine(problem, look, outlier_limit(look), steps, last) || !last.whole) return std::nullopt;
  const FitQuality quality = quality_of(problem, look);
  const double least_near = codes.empty() ? least_near_of_any : least_near_of_known;
  if (quality.likeness < least_likeness || quality.near < least_near || quality.core_near < least_disc_near)
    return std::nullopt;
  const auto decoded = decode_segments(*problem.picture, look.place, {look.blur_px, look.bleed, look.black}, codes);
  if (!decoded || decoded->code != first->code) return std::nullopt;
  if (!shows_the_quarter(problem, look)) return std::nullopt;
  return TargetReading{decoded->code,
                       look.place,
                       look.blur_px,
                       look.bleed,
                       quality.likeness,
                       decoded->margin,
                       center_covariance(problem, look, last)};
}

}  // namespace

TargetStart target_start(const GreyPicture& picture, const DarkBlob& blob) {
  static const DiscMoments disc;
  constexpr int rotations = 12;
  const Eigen::Matrix2d root = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(blob.covariance_px2).operatorSqrt();
  const Eigen::Matrix2d upright = root / disc_radius;
  const auto grid = pattern_grid(0.0, core_radius, 1e9, 10.0);
  const TargetBlur blur(usual_blur_px, 0.0, 2.0 * upright);  // a disc has twice its standard deviation as radius
  std::vector<double> darkness;
  for (const PatternPlace& at : grid) darkness.push_back(disc_darkness_at(at, blur));
  TargetStart best;
  double best_turn = 0.0;
  const auto look = [&](double turn) {
    Eigen::Matrix2d mirror;  // v runs down, y up
    mirror << std::cos(turn), std::sin(turn), std::sin(turn), -std::cos(turn);
    TargetPlace place;
    place.shape = upright * mirror * disc.whitening;
    place.center = blob.center - place.shape * disc.centroid * disc_radius;
    const double likeness = likeness_of(picture, place, grid, darkness);
    if (likeness <= best.likeness) return;
    best = {place, likeness};
    best_turn = turn;
  };
  constexpr double apart_rad = 2.0 * pi / rotations, hopeless = 0.55;
  for (int k = 0; k < rotations; ++k) look(apart_rad * k);
  if (best.likeness < hopeless) return best;
  const double middle_rad = best_turn;
  for (const double share : {-0.5, 0.5}) look(middle_rad + share * apart_rad);
  return best;
}

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
    const double darkness = darkness_of(problem.blackness, place, wide);
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
  finer.covariance_px2 = center_covariance(problem, look, last);
  return finer;
}

std::optional<TargetReading> read_target(const GreyPicture& picture, const TargetStart& start,
                                         const TargetFitOptions& options) {
  if (start.likeness < least_start_likeness) return std::nullopt;
  const std::vector<Appearance> cores = fit_core(picture, start.place);
  const double focal_px =
      options.focal_length_px > 0.0 ? options.focal_length_px : std::max(picture.width, picture.height);
  std::optional<Whole> best;
  for (const Appearance& core : cores)
    for (const Eigen::Vector2d& tilt : possible_tilts(core.place.shape, focal_px)) {
      const auto whole = fit_whole(picture, core, tilt, focal_px);
      if (whole && (!best || whole->likeness > best->likeness)) best = whole;
    }
  return best && best->likeness >= least_soft_likeness ? read_whole(best->problem, best->look, options.codes)
                                                       : std::nullopt;
}

}  // namespace adit
