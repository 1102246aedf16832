#include "core/design/horizontal_element.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/design/transition_curve.h"
#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double widest_panel_rad = 0.3;
constexpr int least_panels = 4;  // of transitions whose curvature is no straight line
constexpr double tightest_curvature_per_m = 2.0;

Eigen::Vector2d direction(double azimuth_rad) {
  return {std::sin(azimuth_rad), std::cos(azimuth_rad)};
}

double sine_over(double a) {
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

/// Integral of the unit tangent over [from, to] of an element by eight Gauss-Legendre points; a panel of 0.3 rad leaves
/// an error far below rounding.
Eigen::Vector2d panel_integral(const HorizontalElement& element, double from_m, double to_m) {
  constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
  const double middle = 0.5 * (from_m + to_m);
  const double half = 0.5 * (to_m - from_m);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < node.size(); ++i) {
    for (const double t : {middle - half * node[i], middle + half * node[i]}) {
      sum += weight[i] * direction(element.azimuth_rad + turn_at(element, t).turn_rad);
    }
  }
  return half * sum;
}

/// Integral of the unit tangent over [from, to] of an element, where its curvature has no corner.
Eigen::Vector2d integral(const HorizontalElement& element, double from_m, double to_m) {
  const double turn = std::abs(to_m - from_m) * strongest_curvature(element);
  const int least = element.kind == HorizontalKind::clothoid ? 1 : least_panels;
  const int panels = std::max(least, static_cast<int>(std::ceil(turn / widest_panel_rad)));
  const double panel_m = (to_m - from_m) / panels;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < panels; ++i) sum += panel_integral(element, from_m + panel_m * i, from_m + panel_m * (i + 1));
  return sum;
}

/// From the element's start to the place `along_m` behind it [m].
Eigen::Vector2d chord(const HorizontalElement& element, double along_m) {
  if (element.start_curvature_per_m == element.end_curvature_per_m) {
    const double half_turn = 0.5 * element.start_curvature_per_m * along_m;
    return along_m * sine_over(half_turn) * direction(element.azimuth_rad + half_turn);
  }
  const double corner_m = 0.5 * element.length_m;
  if (element.kind != HorizontalKind::biquadratic || along_m <= corner_m) return integral(element, 0.0, along_m);
  return integral(element, 0.0, corner_m) + integral(element, corner_m, along_m);
}

PlanPoint parabola_point(const HorizontalElement& element, double along_m) {
  const CubicParabola parabola(element);
  const double x0 = parabola.start_x_m(), x = parabola.x_at(along_m);
  const double base_rad = element.azimuth_rad - parabola.slope_rad(x0);
  const Eigen::Vector2d ahead = direction(base_rad);
  const Eigen::Vector2d right(ahead.y(), -ahead.x());
  return {element.start + (x - x0) * ahead + (parabola.y(x) - parabola.y(x0)) * right, base_rad + parabola.slope_rad(x),
          parabola.curvature_per_m(x)};
}

/// Behind a slope of 1 / sqrt(5), 24 degrees, a cubic parabola grows flatter again.
void check_parabola(const HorizontalElement& element, const std::string& name) {
  if (element.start_curvature_per_m == element.end_curvature_per_m)
    throw Error(name + " is a cubic parabola whose ends are curved alike", {}, "give its radii, or make it an arc");
  const double steepest = 0.5 * element.length_m /
                          std::abs(element.end_curvature_per_m - element.start_curvature_per_m) *
                          std::pow(strongest_curvature(element), 2);
  if (steepest > 1.0 / std::sqrt(5.0))
    throw Error(name + " is a cubic parabola that turns by more than 24 degrees, where it grows flatter again", {},
                "check its length and radius");
}

}  // namespace

Eigen::Vector2d PlanPoint::tangent() const {
  return direction(azimuth_rad);
}

Eigen::Vector2d PlanPoint::right() const {
  return {std::cos(azimuth_rad), -std::sin(azimuth_rad)};
}

double strongest_curvature(const HorizontalElement& element) {
  return std::max(std::abs(element.start_curvature_per_m), std::abs(element.end_curvature_per_m));
}

PlanPoint element_point(const HorizontalElement& element, double along_m) {
  if (element.kind == HorizontalKind::cubic_parabola) return parabola_point(element, along_m);
  const ElementTurn turn = turn_at(element, along_m);
  return {element.start + chord(element, along_m), element.azimuth_rad + turn.turn_rad, turn.curvature_per_m};
}

void check_element(const HorizontalElement& element, std::size_t number) {
  const std::string name = element.name.empty() ? "element " + std::to_string(number + 1) : element.name;
  const bool finite = element.start.allFinite() && std::isfinite(element.azimuth_rad) &&
                      std::isfinite(element.length_m) && std::isfinite(element.start_curvature_per_m) &&
                      std::isfinite(element.end_curvature_per_m);
  if (!finite) throw Error(name + " holds a number that is not finite");
  if (strongest_curvature(element) > tightest_curvature_per_m) {
    throw Error(name + " has a radius under " + short_number(1.0 / tightest_curvature_per_m) + " m", {},
                "check its radius and unit");
  }
  if (element.length_m <= 0.0) throw Error(name + " has no length", {}, "leave elements of no length out");
  constexpr double most_turns_rad = 20.0 * pi;
  if (strongest_curvature(element) * element.length_m > most_turns_rad)
    throw Error(name + " turns by more than ten circles", {}, "check its length, radius and unit");
  if (element.kind == HorizontalKind::cubic_parabola) check_parabola(element, name);
}

}  // namespace adit
