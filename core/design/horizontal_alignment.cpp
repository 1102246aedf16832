#include "core/design/horizontal_alignment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double longest_stretch_m = 1.0;
constexpr double widest_stretch_rad = 0.1;
constexpr double widest_panel_rad = 0.3;
constexpr double end_tolerance_m = 1e-3;
constexpr double tightest_curvature_per_m = 2.0;
constexpr double longest_axis_m = 1e6;  // keeps a wrong unit from taking all memory

Eigen::Vector2d direction(double azimuth_rad) {
  return {std::sin(azimuth_rad), std::cos(azimuth_rad)};
}

std::string metres(double value) {
  return short_number(std::round(value * 1000.0) / 1000.0);
}

double sine_over(double a) {
  return std::abs(a) < 1e-4 ? 1.0 - a * a / 6.0 : std::sin(a) / a;
}

double curvature_rate(const HorizontalElement& element) {
  return (element.end_curvature_per_m - element.start_curvature_per_m) / element.length_m;
}

double strongest_curvature(const HorizontalElement& element) {
  return std::max(std::abs(element.start_curvature_per_m), std::abs(element.end_curvature_per_m));
}

/// Integral of the unit tangent over [from, to] of an element by eight Gauss-Legendre points; a panel of 0.3 rad leaves
/// an error far below rounding.
Eigen::Vector2d panel_integral(const HorizontalElement& element, double rate, double from_m, double to_m) {
  constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                         0.1012285362903763};
  const double middle = 0.5 * (from_m + to_m);
  const double half = 0.5 * (to_m - from_m);
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < node.size(); ++i) {
    for (const double t : {middle - half * node[i], middle + half * node[i]}) {
      sum += weight[i] * direction(element.azimuth_rad + t * (element.start_curvature_per_m + 0.5 * rate * t));
    }
  }
  return half * sum;
}

/// From the element's start to the place `along_m` behind it [m].
Eigen::Vector2d chord(const HorizontalElement& element, double along_m) {
  const double rate = curvature_rate(element);
  if (rate == 0.0) {
    const double half_turn = 0.5 * element.start_curvature_per_m * along_m;
    return along_m * sine_over(half_turn) * direction(element.azimuth_rad + half_turn);
  }
  const double turn = std::abs(along_m) * strongest_curvature(element);
  const int panels = std::max(1, static_cast<int>(std::ceil(turn / widest_panel_rad)));
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i < panels; ++i) {
    sum += panel_integral(element, rate, along_m * i / panels, along_m * (i + 1) / panels);
  }
  return sum;
}

void check(const HorizontalElement& element, std::size_t i) {
  const std::string name = element.name.empty() ? "element " + std::to_string(i + 1) : element.name;
  const bool finite = element.start.allFinite() && std::isfinite(element.azimuth_rad) &&
                      std::isfinite(element.length_m) && std::isfinite(element.start_curvature_per_m) &&
                      std::isfinite(element.end_curvature_per_m);
  if (!finite) throw Error(name + " holds a number that is not finite");
  if (strongest_curvature(element) > tightest_curvature_per_m) {
    throw Error(name + " has a radius under " + short_number(1.0 / tightest_curvature_per_m) + " m", {},
                "check its radius and unit");
  }
  if (element.length_m <= 0.0) throw Error(name + " has no length", {}, "leave elements of no length out");
}

}  // namespace

Eigen::Vector2d PlanPoint::tangent() const {
  return direction(azimuth_rad);
}

Eigen::Vector2d PlanPoint::right() const {
  return {std::cos(azimuth_rad), -std::sin(azimuth_rad)};
}

PlanPoint element_point(const HorizontalElement& element, double along_m) {
  const double rate = curvature_rate(element);
  return {element.start + chord(element, along_m),
          element.azimuth_rad + along_m * (element.start_curvature_per_m + 0.5 * rate * along_m),
          element.start_curvature_per_m + rate * along_m};
}

HorizontalAlignment::HorizontalAlignment(std::vector<HorizontalElement> elements, double start_chainage_m)
    : elements_(std::move(elements)), start_chainage_m_(start_chainage_m) {
  if (elements_.empty()) throw Error("the plan axis has no elements");
  if (!std::isfinite(start_chainage_m))
    throw Error("the start chainage of the plan axis is not finite", {}, "write it in metres");
  double length = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    check(elements_[i], i);
    length += elements_[i].length_m;
  }
  if (length > longest_axis_m) throw Error("the plan axis is longer than 1000 km", {}, "check the unit of its lengths");
  lay_knots();
  lay_discs();
}

void HorizontalAlignment::lay_knots() {
  double element_start = start_chainage_m_;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const HorizontalElement& element = elements_[e];
    const double stretch =
        std::min(longest_stretch_m, widest_stretch_rad / std::max(strongest_curvature(element), 1e-12));
    const auto n = static_cast<std::size_t>(std::ceil(element.length_m / stretch));
    const double step = element.length_m / static_cast<double>(n);
    first_knot_of_element_.push_back(knots_.size());
    for (std::size_t i = 0; i < n; ++i) {
      const double along = step * static_cast<double>(i);
      const PlanPoint point = element_point(element, along);
      knots_.push_back({element_start + along, step, point.position, point.tangent(), point.curvature_per_m,
                        curvature_rate(element), point.azimuth_rad, e});
    }
    element_start += element.length_m;
  }
  end_chainage_m_ = element_start;
  const auto metres = static_cast<std::size_t>(end_chainage_m_ - start_chainage_m_) + 1;
  std::size_t knot = 0;
  for (std::size_t i = 0; i < metres; ++i) {
    while (knot + 1 < knots_.size() && knots_[knot + 1].chainage_m <= start_chainage_m_ + static_cast<double>(i))
      ++knot;
    knot_of_metre_.push_back(knot);
  }
}

std::size_t HorizontalAlignment::knot_at(double chainage_m) const {
  const double metre = std::clamp(chainage_m - start_chainage_m_, 0.0, static_cast<double>(knot_of_metre_.size() - 1));
  std::size_t knot = knot_of_metre_[static_cast<std::size_t>(metre)];
  while (knot + 1 < knots_.size() && knots_[knot + 1].chainage_m <= chainage_m) ++knot;
  return knot;
}

double HorizontalAlignment::checked(double chainage_m) const {
  if (knots_.empty()) throw Error("the plan axis has no elements");
  if (!(chainage_m >= start_chainage_m_ - end_tolerance_m && chainage_m <= end_chainage_m_ + end_tolerance_m)) {
    throw Error("chainage " + metres(chainage_m) + " lies outside the axis, which runs from " +
                metres(start_chainage_m_) + " to " + metres(end_chainage_m_));
  }
  return std::clamp(chainage_m, start_chainage_m_, end_chainage_m_);
}

PlanPoint HorizontalAlignment::at(double chainage_m) const {
  const double s = checked(chainage_m);
  const PlanKnot& knot = knots_[knot_at(s)];
  const double t = s - knot.chainage_m;
  const PlanKnot::Local axis = knot.local(t);
  return {knot.position + axis.along_m * knot.tangent + axis.right_m * knot.right(),
          knot.azimuth_rad + knot.turn_rad(t), knot.curvature_at(t)};
}

Eigen::Vector2d HorizontalAlignment::to_plan(const PlanFoot& foot) const {
  const double s = checked(foot.chainage_m);
  const PlanKnot& knot = knots_[knot_at(s)];
  const PlanKnot::Local axis = knot.local(s - knot.chainage_m);
  return knot.position + (axis.along_m - foot.offset_m * axis.sine) * knot.tangent +
         (axis.right_m + foot.offset_m * axis.cosine) * knot.right();
}

AxisBend HorizontalAlignment::bend_between(double from_m, double to_m) const {
  AxisBend bend;
  for (std::size_t k = knot_at(from_m); k < knots_.size() && knots_[k].chainage_m <= to_m; ++k) {
    const PlanKnot& knot = knots_[k];
    bend.strongest_per_m =
        std::max({bend.strongest_per_m, std::abs(knot.curvature_per_m), std::abs(knot.curvature_at(knot.length_m))});
    if (k + 1 == knots_.size() || knots_[k + 1].element == knot.element || knots_[k + 1].chainage_m > to_m) continue;
    const PlanPoint end = element_point(elements_[knot.element], elements_[knot.element].length_m);
    bend.kinks_rad += std::abs(std::remainder(knots_[k + 1].azimuth_rad - end.azimuth_rad, 2.0 * pi));
    bend.gaps_m += (knots_[k + 1].position - end.position).norm();
  }
  return bend;
}

HorizontalAlignment HorizontalAlignment::relative_to(const Eigen::Vector2d& origin) const {
  std::vector<HorizontalElement> moved = elements_;
  for (HorizontalElement& element : moved) element.start -= origin;
  return HorizontalAlignment(std::move(moved), start_chainage_m_);
}

}  // namespace adit
