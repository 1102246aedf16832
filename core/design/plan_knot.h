#pragma once
// A place on the plan axis from which a stretch of at most a metre is seen without trigonometry.

#include <Eigen/Core>

#include <cstddef>

namespace adit {

/// A knot of the plan axis: every metre, closer in tight curves, and at every element's start. Its stretch turns by at
/// most 0.1 rad, so three Gauss-Legendre points and short series for sine and cosine are exact to 1e-12 m.
struct PlanKnot {
  double chainage_m = 0.0;
  double length_m = 0.0;                               ///< of the stretch
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< east, north [m]
  Eigen::Vector2d tangent = Eigen::Vector2d::UnitY();  ///< unit, up-chainage
  double curvature_per_m = 0.0;                        ///< right-hand turns positive
  double curvature_rate_per_m2 = 0.0;
  double curvature_bend_per_m3 = 0.0;  ///< its second derivative
  double azimuth_rad = 0.0;
  std::size_t element = 0;

  /// The axis t metres behind the knot, in the knot's frame: along its tangent and to its right [m]; cosine and sine of
  /// the turn since the knot.
  struct Local {
    double along_m;
    double right_m;
    double cosine;
    double sine;
  };
  Local local(double t_m) const;

  /// A point seen from the axis t metres behind the knot: how far ahead its foot seems to lie [m], offset to the right
  /// [m], and 1 - curvature * offset (positive up to the centre of curvature).
  struct View {
    double ahead_m;
    double offset_m;
    double slope;
  };
  View view(const Eigen::Vector2d& point, double t_m) const;

  /// Turn since the knot [rad].
  double turn_rad(double t_m) const {
    return t_m * (curvature_per_m + t_m * (0.5 * curvature_rate_per_m2 + (1.0 / 6.0) * curvature_bend_per_m3 * t_m));
  }
  double curvature_at(double t_m) const {
    return curvature_per_m + t_m * (curvature_rate_per_m2 + 0.5 * curvature_bend_per_m3 * t_m);
  }
  Eigen::Vector2d right() const { return {tangent.y(), -tangent.x()}; }
};

namespace plan_knot_series {

// Products with constants: a division takes as long as the whole series.

inline double sine(double a) {
  const double q = a * a;
  return a * (1.0 - q * (1.0 / 6.0) * (1.0 - q * (1.0 / 20.0) * (1.0 - q * (1.0 / 42.0) * (1.0 - q * (1.0 / 72.0)))));
}
inline double cosine(double a) {
  const double q = a * a;
  return 1.0 -
         q * 0.5 *
             (1.0 - q * (1.0 / 12.0) * (1.0 - q * (1.0 / 30.0) * (1.0 - q * (1.0 / 56.0) * (1.0 - q * (1.0 / 90.0)))));
}

}  // namespace plan_knot_series

inline PlanKnot::Local PlanKnot::local(double t_m) const {
  constexpr double node = 0.11270166537925831148;  // (1 - sqrt(3/5)) / 2
  const double a = turn_rad(node * t_m);
  const double b = turn_rad(0.5 * t_m);
  const double c = turn_rad((1.0 - node) * t_m);
  const double d = turn_rad(t_m);
  using plan_knot_series::cosine;
  using plan_knot_series::sine;
  return {t_m * (5.0 * (cosine(a) + cosine(c)) + 8.0 * cosine(b)) / 18.0,
          t_m * (5.0 * (sine(a) + sine(c)) + 8.0 * sine(b)) / 18.0, cosine(d), sine(d)};
}

inline PlanKnot::View PlanKnot::view(const Eigen::Vector2d& point, double t_m) const {
  const Local axis = local(t_m);
  const Eigen::Vector2d from_knot = point - position;
  const double along = from_knot.dot(tangent) - axis.along_m;
  const double across = from_knot.dot(right()) - axis.right_m;
  const double offset = across * axis.cosine - along * axis.sine;
  return {along * axis.cosine + across * axis.sine, offset, 1.0 - curvature_at(t_m) * offset};
}

}  // namespace adit
