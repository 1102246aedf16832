#include "core/georeference/target_adjustment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double blur_sigma_px = 0.6, bleed_sigma = 0.7;  // what is known beforehand

Eigen::RowVector2d gradient_at(const GreyPicture& picture, const Eigen::Vector2d& pixel) {
  const auto value = [&](double du, double dv) { return picture.between(pixel.x() + du, pixel.y() + dv); };
  return {value(0.5, 0.0) - value(-0.5, 0.0), value(0.0, 0.5) - value(0.0, -0.5)};
}

bool holds_with_gradient(const GreyPicture& picture, const Eigen::Vector2d& pixel) {
  return picture.holds(pixel.x() - 0.5, pixel.y() - 0.5) && picture.holds(pixel.x() + 0.5, pixel.y() + 0.5);
}

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

/// The sums with what is known of perspective, as a whole matrix.
NormalMatrix normal_of(const FitProblem& problem, const FitSums& sums) {
  NormalMatrix normal = sums.normal.selfadjointView<Eigen::Lower>();
  const double variance = std::max(1.0, sums.cost / std::max(1.0, sums.weight));
  for (int k = 8; k < 10; ++k) normal(k, k) += variance / (problem.tilt_sigma * problem.tilt_sigma);
  normal(10, 10) += variance / (blur_sigma_px * blur_sigma_px);
  normal(13, 13) += variance / (bleed_sigma * bleed_sigma);
  return normal;
}

}  // namespace

double long_radius_px(const Eigen::Matrix2d& shape) {
  return Eigen::JacobiSVD<Eigen::Matrix2d>(shape).singularValues()(0);
}

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

Eigen::Matrix2d center_covariance(const FitProblem& problem, const Appearance& look, const FitSums& sums) {
  NormalMatrix normal = normal_of(problem, sums);
  normal.diagonal().array() += 1e-9;
  const double variance = sums.cost / std::max(1.0, sums.weight - unknowns);
  // Places closer than pixels are not independent.
  const double pixels = std::abs(look.place.shape.determinant()) * pi * whole_radius * whole_radius;
  const double dense = std::max(1.0, static_cast<double>(problem.grid.size()) / pixels);
  // What the model leaves out (bent edges, the sensor's own light curve, neighbouring places' common noise), measured
  // on simulated pictures: docs/accuracy.md.
  constexpr double model_factor = 2.0, of_radius = 0.0008;
  const double model_px = of_radius * long_radius_px(look.place.shape);
  return (normal.inverse() * (model_factor * model_factor * dense * variance)).topLeftCorner<2, 2>() +
         model_px * model_px * Eigen::Matrix2d::Identity();
}

}  // namespace adit
