#include "core/design/transition_curve.h"

#include <array>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit {
namespace {

/// Share of the change of curvature that is done at u, and its integral from 0 to u.
struct Change {
  double done;
  double integral;
};

Change change_at(HorizontalKind kind, double u) {
  switch (kind) {
    case HorizontalKind::bloss:
      return {u * u * (3.0 - 2.0 * u), u * u * u * (1.0 - 0.5 * u)};
    case HorizontalKind::cosine:
      return {0.5 * (1.0 - std::cos(pi * u)), 0.5 * (u - std::sin(pi * u) / pi)};
    case HorizontalKind::sinusoid:
      return {u - std::sin(2.0 * pi * u) / (2.0 * pi), 0.5 * u * u + (std::cos(2.0 * pi * u) - 1.0) / (4.0 * pi * pi)};
    case HorizontalKind::biquadratic: {
      const double left = 1.0 - u;
      if (u <= 0.5) return {2.0 * u * u, 2.0 / 3.0 * u * u * u};
      return {1.0 - 2.0 * left * left, u - 0.5 + 2.0 / 3.0 * left * left * left};
    }
    default:
      return {u, 0.5 * u * u};
  }
}

/// Length of y = x^3 / (6 C) between two x: Gauss-Legendre, eight points on each of four panels. Slopes stay under half
/// (check_element), which leaves an error far below rounding.
double arc_length_m(double constant_m2, double from_x, double to_x) {
  constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
  constexpr int panels = 4;
  const double half = 0.5 * (to_x - from_x) / panels;
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from_x + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < node.size(); ++i)
      for (const double x : {middle - half * node[i], middle + half * node[i]})
        sum += weight[i] * std::hypot(1.0, 0.5 * x * x / constant_m2);
  }
  return half * sum;
}

}  // namespace

double share_done(HorizontalKind kind, double u) {
  return change_at(kind, u).done;
}

ElementTurn turn_at(const HorizontalElement& element, double along_m) {
  const double start = element.start_curvature_per_m;
  const double change = element.end_curvature_per_m - start;
  if (change == 0.0) return {along_m * start, start};
  const Change so_far = change_at(element.kind, along_m / element.length_m);
  return {along_m * start + element.length_m * change * so_far.integral, start + change * so_far.done};
}

CubicParabola::CubicParabola(const HorizontalElement& element) {
  const double k0 = element.start_curvature_per_m, k1 = element.end_curvature_per_m;
  constant_m2_ = element.length_m / (k1 - k0);  // its projection's length for its own, which is a little longer
  for (int n = 0; n < 20; ++n) {                // the ratio settles quadratically: slopes are small
    const double length_m = arc_length_m(constant_m2_, constant_m2_ * k0, constant_m2_ * k1);
    constant_m2_ *= element.length_m / length_m;
  }
  start_x_m_ = constant_m2_ * k0;
}

double CubicParabola::x_at(double along_m) const {
  double x = start_x_m_ + along_m;
  for (int n = 0; n < 20; ++n) {
    const double step =
        (arc_length_m(constant_m2_, start_x_m_, x) - along_m) / std::hypot(1.0, 0.5 * x * x / constant_m2_);
    x -= step;
    if (std::abs(step) < 1e-13) break;
  }
  return x;
}

double CubicParabola::slope_rad(double x_m) const {
  return std::atan(0.5 * x_m * x_m / constant_m2_);
}

double CubicParabola::curvature_per_m(double x_m) const {
  const double slope = 0.5 * x_m * x_m / constant_m2_;
  return x_m / constant_m2_ / std::pow(1.0 + slope * slope, 1.5);
}

double parabola_length_m(double x_m, double curvature_per_m) {
  return arc_length_m(x_m / curvature_per_m, 0.0, x_m);
}

}  // namespace adit
