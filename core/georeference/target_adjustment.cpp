#include "core/georeference/target_adjustment.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double pattern_end = 1.04;                      // beyond, the paper of small targets ends
constexpr double least_shape_px2 = 1.0;                   // of radii along and across: nothing is read that small
constexpr double blur_sigma_px = 0.6, bleed_sigma = 0.7;  // what is known beforehand

/// The picture between the pixels, and by how much it rises over one of them (from half a pixel before to half behind).
struct Grey {
  double value, along_u, along_v;

  Grey(const GreyPicture& picture, const Eigen::Vector2d& pixel) {
    const int i = static_cast<int>(pixel.x()), j = static_cast<int>(pixel.y());
    const double a = pixel.x() - i, b = pixel.y() - j;
    // The rise crosses the cell of the place and the one on its nearer side.
    const int left = a < 0.5 ? i - 1 : i, top = b < 0.5 ? j - 1 : j;
    const double right_share = a < 0.5 ? a + 0.5 : a - 0.5, low_share = b < 0.5 ? b + 0.5 : b - 0.5;
    const std::uint8_t* row = picture.pixels.data() + picture.index(i, j);
    const std::uint8_t* next = row + picture.width;
    const auto column = [&](int k) { return (1.0 - b) * row[k - i] + b * next[k - i]; };
    const auto line = [&](int k) {
      const std::uint8_t* at = row + (k - j) * picture.width;
      return (1.0 - a) * at[0] + a * at[1];
    };
    value = (1.0 - b) * line(j) + b * line(j + 1);
    along_u =
        (1.0 - right_share) * (column(left + 1) - column(left)) + right_share * (column(left + 2) - column(left + 1));
    along_v = (1.0 - low_share) * (line(top + 1) - line(top)) + low_share * (line(top + 2) - line(top + 1));
  }
};

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

Shade shade_of(const FitProblem& problem, const PatternPlace& place, const TargetBlur& blur) {
  return problem.with_segments ? shade_of(problem.blackness, place, blur) : disc_shade_at(place, blur);
}

double value_of(const Appearance& look, const Eigen::Vector2d& at, double darkness) {
  return look.white + look.white_slope.dot(at) - look.black * darkness;
}

/// The first unknowns of all.
template <int count>
using Row = Eigen::Matrix<double, count, 1>;

/// d (grey of the picture - value of the pattern) / d unknowns.
template <int count>
Row<count> row_of(const Appearance& look, const Eigen::Vector2d& at, const Grey& grey, const Shade& shade) {
  const double scale = 1.0 / (1.0 + look.place.tilt.dot(at));
  const double u = grey.along_u, v = grey.along_v;
  const double x = at.x() * scale, y = at.y() * scale;
  Row<count> row;
  row.template head<few_unknowns>() << u, v, u * x, u * y, v * x, v * y, -1.0, shade.value;
  if constexpr (count > few_unknowns) {
    const Eigen::Vector2d shaped = look.place.shape * at;
    const double along_tilt = -scale * (u * shaped.x() + v * shaped.y());
    row.template tail<count - few_unknowns>() << along_tilt * x, along_tilt * y,
        look.black * shade.by_log_blur / look.blur_px, -at.x(), -at.y(), look.black * shade.by_bleed;
  }
  return row;
}

/// Lower half, and some above it: columns from even rows on, which the processor takes two numbers at a time.
template <int count, int column = 0>
void add_row(FitSums& sums, const Row<count>& row, const Row<count>& weighed) {
  if constexpr (column < count) {
    constexpr int first = column - column % 2;
    sums.normal.template block<count - first, 1>(first, column) +=
        weighed(column) * row.template segment<count - first>(first);
    add_row<count, column + 1>(sums, row, weighed);
  }
}

/// Huber's weights: what lies off by more than `limit` grey levels (a cover, dust, glare) counts less.
template <int count>
FitSums sums_of(const FitProblem& problem, const Appearance& look, double limit) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  FitSums sums;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!holds_with_gradient(*problem.picture, pixel)) {
      sums.whole = false;
      continue;
    }
    const Shade shade = shade_of(problem, place, blur);
    const Grey grey(*problem.picture, pixel);
    const double off = grey.value - value_of(look, place.at, shade.value);
    const double weight = std::abs(off) > limit ? limit / std::abs(off) : 1.0;
    sums.cost += weight * off * off;
    sums.weight += weight;
    const Row<count> row = row_of<count>(look, place.at, grey, shade), weighed = weight * row;
    sums.right.head<count>() -= off * weighed;
    add_row<count>(sums, row, weighed);
  }
  return sums;
}

FitSums sums_of(const FitProblem& problem, const Appearance& look, double limit) {
  return problem.few ? sums_of<few_unknowns>(problem, look, limit) : sums_of<unknowns>(problem, look, limit);
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

FitProblem disc_problem(const GreyPicture& picture, const TargetPlace& place) {
  constexpr double across = 11.0, no_tilt = 1e-3;
  const double radius_px = long_radius_px(place.shape);
  return {&picture, pattern_grid(0.0, core_radius, radius_px, across), false, {}, true, {0.0, 0.0}, no_tilt};
}

void set_levels(const FitProblem& problem, Appearance& look) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  double n = 0.0, d = 0.0, dd = 0.0, g = 0.0, dg = 0.0;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d& at = place.at;
    const Eigen::Vector2d pixel = look.place.pixel(at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) continue;
    const double darkness = shade_of(problem, place, blur).value, grey = problem.picture->between(pixel.x(), pixel.y());
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

namespace {

/// The next step, damped.
template <int count>
Unknowns step_of(const NormalMatrix& normal, const Unknowns& right, double damping) {
  Eigen::Matrix<double, count, count> damped = normal.template topLeftCorner<count, count>();
  damped.diagonal() = (1.0 + damping) * damped.diagonal().array() + 1e-9;
  Unknowns by = Unknowns::Zero();
  by.template head<count>() = damped.ldlt().solve(right.template head<count>());
  return by;
}

}  // namespace

bool refine(const FitProblem& problem, Appearance& look, double limit, int most_steps, FitSums& last) {
  last = sums_of(problem, look, limit);
  return refine_on(problem, look, limit, most_steps, last);
}

bool refine_on(const FitProblem& problem, Appearance& look, double limit, int most_steps, FitSums& last) {
  double damping = 1e-3;
  for (int i = 0; i < most_steps; ++i) {
    if (last.weight < 20.0) return false;
    const NormalMatrix normal = normal_of(problem, last);
    Unknowns right = last.right;
    const double variance = std::max(1.0, last.cost / last.weight);
    right.segment<2>(8) +=
        variance / (problem.tilt_sigma * problem.tilt_sigma) * (problem.tilt_prior - look.place.tilt);
    right(10) += variance / (blur_sigma_px * blur_sigma_px) * (usual_blur_px - look.blur_px);
    right(13) -= variance / (bleed_sigma * bleed_sigma) * look.bleed;
    const Unknowns by =
        problem.few ? step_of<few_unknowns>(normal, right, damping) : step_of<unknowns>(normal, right, damping);
    if (!by.allFinite()) return false;
    Appearance moved = look;
    move(moved, by);
    if (!(moved.place.shape.determinant() < -least_shape_px2) || moved.place.tilt.norm() > 0.8) return false;
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

FitProblem of_near_places(const FitProblem& problem, const Appearance& look) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  const double limit = 2.0 * outlier_limit(look);
  FitProblem near = problem;
  std::erase_if(near.grid, [&](const PatternPlace& place) {
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) return true;
    const double value = value_of(look, place.at, shade_of(problem, place, blur).value);
    return std::abs(problem.picture->between(pixel.x(), pixel.y()) - value) > limit;
  });
  return near;
}

FitQuality quality_of(const FitProblem& problem, const Appearance& look) {
  const TargetBlur blur(look.blur_px, look.bleed, look.place.shape);
  const double limit = 2.0 * outlier_limit(look);
  Correlation correlation;
  double all = 0.0, near = 0.0, core = 0.0, core_near = 0.0;
  for (const PatternPlace& place : problem.grid) {
    const Eigen::Vector2d pixel = look.place.pixel(place.at);
    if (!problem.picture->holds(pixel.x(), pixel.y())) continue;
    const double darkness = shade_of(problem, place, blur).value;
    const double grey = problem.picture->between(pixel.x(), pixel.y());
    const bool is_near = std::abs(grey - value_of(look, place.at, darkness)) <= limit;
    const bool in_core = place.radius < core_radius;
    const bool counts = place.radius < pattern_end;
    all += counts ? 1.0 : 0.0;
    core += in_core ? 1.0 : 0.0;
    near += is_near && counts ? 1.0 : 0.0;
    core_near += is_near && in_core ? 1.0 : 0.0;
    if (is_near) correlation.add(grey - look.white_slope.dot(place.at), -darkness);
  }
  return {correlation.value(), near / std::max(1.0, all), core_near / std::max(1.0, core)};
}

namespace {

/// Pixels of a box, what they are off the pattern and what the pattern says; those that do not count are off by NaN.
struct Residuals {
  int width, height;
  std::vector<double> off, pattern;
};

Residuals residuals_of(const FitProblem& problem, const Appearance& look) {
  constexpr double least_blur_px = 0.3, between_pixels_px2 = 1.0 / 6.0;  // variance that bilinear values add
  const double blur_px =
      std::max(least_blur_px, std::sqrt(std::max(0.0, look.blur_px * look.blur_px - between_pixels_px2)));
  const TargetBlur blur(blur_px, look.bleed, look.place.shape);
  const GreyPicture& picture = *problem.picture;
  const Eigen::Vector2d& center = look.place.center;
  const double reach = 1.3 * long_radius_px(look.place.shape) + 2.0, limit = 2.0 * outlier_limit(look);
  const int left = std::max(0, static_cast<int>(center.x() - reach)),
            right = std::min(picture.width - 1, static_cast<int>(center.x() + reach)),
            top = std::max(0, static_cast<int>(center.y() - reach)),
            low = std::min(picture.height - 1, static_cast<int>(center.y() + reach));
  Residuals residuals{right - left + 1, low - top + 1, {}, {}};
  for (int v = top; v <= low; ++v)
    for (int u = left; u <= right; ++u) {
      const Eigen::Vector2d away = Eigen::Vector2d(u, v) - center;
      const Eigen::Vector2d at = (look.place.shape - away * look.place.tilt.transpose()).inverse() * away;
      double off = std::numeric_limits<double>::quiet_NaN(), pattern = 0.0;
      if (at.norm() < pattern_end && 1.0 + look.place.tilt.dot(at) > 0.0) {
        const double darkness = shade_of(problem, PatternPlace(at), blur).value;
        const double rest = picture.at(u, v) - value_of(look, at, darkness);
        pattern = look.black * darkness;
        if (std::abs(rest) <= limit) off = rest;
      }
      residuals.off.push_back(off);
      residuals.pattern.push_back(pattern);
    }
  return residuals;
}

struct Moments {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double a) {
    n += 1.0;
    sum += a;
    squares += a * a;
  }
  double mean_square() const { return squares / std::max(1.0, n); }
  double variance() const { return mean_square() - sum * sum / std::max(1.0, n * n); }
};

}  // namespace

double unexplained_share(const FitProblem& problem, const Appearance& look) {
  const Residuals residuals = residuals_of(problem, look);
  Moments off, pattern, steps;
  for (int v = 0; v < residuals.height; ++v)
    for (int u = 0; u < residuals.width; ++u) {
      const auto i = static_cast<std::size_t>(v * residuals.width + u);
      if (std::isnan(residuals.off[i])) continue;
      off.add(residuals.off[i]);
      pattern.add(residuals.pattern[i]);
      const auto step_to = [&](std::size_t k) {
        if (!std::isnan(residuals.off[k])) steps.add(residuals.off[i] - residuals.off[k]);
      };
      if (u + 1 < residuals.width) step_to(i + 1);
      if (v + 1 < residuals.height) step_to(i + static_cast<std::size_t>(residuals.width));
    }
  const double noise = 0.5 * steps.mean_square();
  return pattern.variance() > 0.0 ? (off.variance() - noise) / pattern.variance() : 1.0;
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
