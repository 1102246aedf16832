#pragma once
// Plan geometry of an axis: lines, arcs and transition curves, both ways.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "core/design/horizontal_element.h"
#include "core/design/plan_knot.h"

namespace adit {

/// Foot of a point on the axis.
struct PlanFoot {
  double chainage_m = 0.0;
  double offset_m = 0.0;  ///< right positive
};

/// How an axis turns within a stretch.
struct AxisBend {
  double strongest_per_m = 0.0;  ///< greatest curvature, to either side
  double kinks_rad = 0.0;        ///< between elements, added up
  double gaps_m = 0.0;           ///< likewise
};

/// The plan axis. Elements follow each other; every element keeps its own start, so that small gaps of the file (under
/// a millimetre) do not add up. Chainage is start_chainage + the sum of lengths: internal, without station equations.
class HorizontalAlignment {
 public:
  HorizontalAlignment() = default;
  /// Throws Error, naming the element, when there is none, a length is not positive or a number is not finite.
  HorizontalAlignment(std::vector<HorizontalElement> elements, double start_chainage_m);

  const std::vector<HorizontalElement>& elements() const { return elements_; }
  /// Chainage at which element i begins.
  double element_from_m(std::size_t i) const { return knots_[first_knot_of_element_[i]].chainage_m; }
  double from_m() const { return start_chainage_m_; }
  double to_m() const { return end_chainage_m_; }

  /// Throws Error outside [from, to] (1 mm tolerance). At a joint the later element answers.
  PlanPoint at(double chainage_m) const;

  /// East and north of a place beside the axis; the way back of foot(). Throws Error outside [from, to] (1 mm
  /// tolerance). Faster than at(): no trigonometry.
  Eigen::Vector2d to_plan(const PlanFoot& foot) const;

  /// Nearest foot of a point: (P - C(s)) . T(s) = 0 solved to 1e-9 m. Empty when the point lies before the start or
  /// behind the end of the axis (by more than 1 mm), or further from it than the radius of curvature. Where elements
  /// meet with a small gap or kink, the wedge without a foot belongs to the joint. With a hint (a chainage within some
  /// metres of the answer) the search starts there and stays within 30 m of it: about 0.1 microseconds.
  std::optional<PlanFoot> foot(const Eigen::Vector2d& point, std::optional<double> hint_m = std::nullopt) const;

  /// All feet of a point that lie at most `beyond_m` farther from it than the nearest one, in order of chainage:
  /// several where the axis comes back beside or above itself.
  std::vector<PlanFoot> feet(const Eigen::Vector2d& point, double beyond_m) const;

  /// Of the stretch [from, to], or what of it lies on the axis.
  AxisBend bend_between(double from_m, double to_m) const;

  /// The same axis with `origin` (east, north) subtracted.
  HorizontalAlignment relative_to(const Eigen::Vector2d& origin) const;

 private:
  struct Disc {  ///< holds all the axis from knot (or disc) `first` up to `last`, exclusive
    Eigen::Vector2d centre;
    double radius_m;
    std::size_t first;
    std::size_t last;
  };
  struct Settled;  // what Newton's iteration came to

  void lay_knots();
  void lay_discs();
  std::size_t knot_at(double chainage_m) const;
  double checked(double chainage_m) const;
  std::vector<std::size_t> nearest_knots(const Eigen::Vector2d& point, double beyond_m) const;
  std::size_t nearest_leaf(const Eigen::Vector2d& point) const;
  std::optional<PlanFoot> foot_near(const Eigen::Vector2d& point, double hint_m) const;
  Settled settle(const Eigen::Vector2d& point, double chainage_m) const;
  Settled settle_at_end(const Eigen::Vector2d& point, bool at_start) const;
  Settled settle_in(const Eigen::Vector2d& point, std::size_t knot) const;
  std::optional<PlanFoot> joint_foot(const Eigen::Vector2d& point, std::size_t later_element) const;

  std::vector<HorizontalElement> elements_;
  std::vector<PlanKnot> knots_;
  std::vector<std::size_t> first_knot_of_element_;
  std::vector<std::size_t> knot_of_metre_;  ///< knot that holds start_chainage + i metres
  std::vector<Disc> leaves_;                ///< over knots
  std::vector<Disc> branches_;              ///< over leaves
  double start_chainage_m_ = 0.0;
  double end_chainage_m_ = 0.0;
};

}  // namespace adit
