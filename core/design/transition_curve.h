#pragma once
// How the elements of an axis turn.

#include <Eigen/Core>

#include "core/design/horizontal_element.h"

namespace adit {

/// Turn since the element's start [rad] and curvature [1/m], right-hand positive.
struct ElementTurn {
  double turn_rad = 0.0;
  double curvature_per_m = 0.0;
};

/// Share of the change between both ends that is done at u, 0 to 1, of the length; see HorizontalKind. Linear for
/// lines, arcs, clothoids and cubic parabolas.
double share_done(HorizontalKind kind, double u);

/// At a place on a line, arc or transition curve whose curvature is a function of its length; see HorizontalKind.
ElementTurn turn_at(const HorizontalElement& element, double along_m);

/// A cubic parabola y = x^3 / (6 C), x ahead along the tangent where it is straight, y to its right.
class CubicParabola {
 public:
  /// Of an element; y'' = x / C at its ends are its curvatures, C follows from its length along the curve.
  explicit CubicParabola(const HorizontalElement& element);

  /// x so far along the curve behind the element's start.
  double x_at(double along_m) const;
  double start_x_m() const { return start_x_m_; }
  double y(double x_m) const { return x_m * x_m * x_m / (6.0 * constant_m2_); }
  double slope_rad(double x_m) const;
  double curvature_per_m(double x_m) const;

 private:
  double constant_m2_ = 1.0;
  double start_x_m_ = 0.0;
};

/// Length of a cubic parabola from where it is straight to x, where its y'' is `curvature_per_m`.
double parabola_length_m(double x_m, double curvature_per_m);

}  // namespace adit
