#pragma once
// One element of a plan axis: a line, an arc or a transition curve.

#include <Eigen/Core>

#include <string>

namespace adit {

/// How curvature goes from an element's start to its end, u = share of its length. Of a cubic parabola the ends are
/// those of y'' in y = x^3 / (6 C), x along the tangent where it is straight: true curvature is a little less.
enum class HorizontalKind {
  line,
  arc,
  clothoid,        ///< u
  bloss,           ///< 3 u^2 - 2 u^3
  cosine,          ///< (1 - cos pi u) / 2
  sinusoid,        ///< u - sin(2 pi u) / (2 pi) (Klein)
  biquadratic,     ///< 2 u^2, from the middle on 1 - 2 (1 - u)^2 (Helmert, Schramm)
  cubic_parabola,  ///< between any two places of one parabola
};

/// Curvature right-hand turns positive (both zero for a line, equal for an arc). Azimuth clockwise from north.
struct HorizontalElement {
  HorizontalKind kind = HorizontalKind::line;
  std::string name;                                 ///< for messages: "Spiral 3", "Curve K12"
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< east, north [m]
  double azimuth_rad = 0.0;                         ///< direction at start
  double length_m = 0.0;
  double start_curvature_per_m = 0.0;
  double end_curvature_per_m = 0.0;
};

/// Plan position on the axis.
struct PlanPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< east, north [m]
  double azimuth_rad = 0.0;                            ///< clockwise from north
  double curvature_per_m = 0.0;                        ///< right-hand turns positive

  Eigen::Vector2d tangent() const;  ///< unit (east, north) up-chainage
  Eigen::Vector2d right() const;    ///< unit, a quarter turn clockwise from the tangent
};

/// Position and direction along an element, from its own start: lines, arcs and cubic parabolas in closed form, other
/// transition curves by Gauss-Legendre integration, exact to 1e-11 m on elements of up to several kilometres (beside
/// the rounding of large coordinates).
PlanPoint element_point(const HorizontalElement& element, double along_m);

/// Throws Error, naming the element (or its number, counted from 0), when a number is not finite, it has no length, a
/// radius under 0.5 m, turns by more than ten circles, or is a cubic parabola that reaches its least radius.
void check_element(const HorizontalElement& element, std::size_t number);

/// Greatest curvature to either side anywhere on it.
double strongest_curvature(const HorizontalElement& element);

}  // namespace adit
