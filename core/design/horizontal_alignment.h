#pragma once
// Plan geometry of an axis: lines, arcs and clothoids, both ways.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace adit {

enum class HorizontalKind { line, arc, clothoid };

/// One element: curvature is linear in length, from start_curvature to end_curvature (right-hand turns positive; both
/// zero for a line, equal for an arc). Azimuth clockwise from north.
struct HorizontalElement {
  HorizontalKind kind = HorizontalKind::line;
  std::string name;                                    ///< for messages: "Spiral 3", "Curve K12"
  Eigen::Vector2d start = Eigen::Vector2d::Zero();     ///< east, north [m]
  double azimuth_rad = 0.0;                            ///< direction at start
  double length_m = 0.0;
  double start_curvature_per_m = 0.0;
  double end_curvature_per_m = 0.0;
};

/// Plan position on the axis.
struct PlanPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< east, north [m]
  double azimuth_rad = 0.0;                            ///< clockwise from north
  double curvature_per_m = 0.0;                        ///< right-hand turns positive

  Eigen::Vector2d tangent() const;                     ///< unit (east, north) up-chainage
  Eigen::Vector2d right() const;                       ///< unit, a quarter turn clockwise from the tangent
};

/// Foot of a point on the axis.
struct PlanFoot {
  double chainage_m = 0.0;
  double offset_m = 0.0;  ///< right positive
};

/// Position and direction at the end of an element, from its own start: Gauss-Legendre integration of the linear
/// curvature, exact to 1e-11 m on elements of up to several kilometres.
PlanPoint element_point(const HorizontalElement& element, double along_m);

/// The plan axis. Elements follow each other; every element keeps its own start, so that small gaps of the file (under
/// a millimetre) do not add up. Chainage is start_chainage + the sum of lengths: internal, without station equations.
class HorizontalAlignment {
 public:
  HorizontalAlignment() = default;
  HorizontalAlignment(std::vector<HorizontalElement> elements, double start_chainage_m);

  const std::vector<HorizontalElement>& elements() const { return elements_; }
  double from_m() const { return start_chainage_m_; }
  double to_m() const { return end_chainage_m_; }

  /// Throws Error outside [from, to] (1 mm tolerance).
  PlanPoint at(double chainage_m) const;

  /// Nearest foot of a point: (P - C(s)) . T(s) = 0 solved to 1e-9 m. Empty when the point lies before the start or
  /// behind the end of the axis, or further from it than the radius of curvature. With a hint (a chainage within some
  /// metres of the answer) the search starts there and stays within 30 m of it: about 0.1 microseconds.
  std::optional<PlanFoot> foot(const Eigen::Vector2d& point, std::optional<double> hint_m = std::nullopt) const;

  /// The same axis with `origin` (east, north) subtracted.
  HorizontalAlignment relative_to(const Eigen::Vector2d& origin) const;

 private:
  struct Knot {  ///< every metre and at every element start: local series about it are exact to rounding
    double chainage_m;
    std::size_t element;
    PlanPoint point;
    double curvature_rate_per_m2;
    double end_chainage_m;  ///< the knot's stretch ends here
  };
  std::vector<HorizontalElement> elements_;
  std::vector<double> element_start_m_;
  std::vector<Knot> knots_;
  double start_chainage_m_ = 0.0;
  double end_chainage_m_ = 0.0;
};

}  // namespace adit
