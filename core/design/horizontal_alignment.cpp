#include "core/design/horizontal_alignment.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double longest_stretch_m = 1.0;
constexpr double widest_stretch_rad = 0.1;
constexpr double end_tolerance_m = 1e-3;
constexpr double longest_axis_m = 1e6;  // keeps a wrong unit from taking all memory
constexpr double farthest_m = 1e8;      // of chainages and coordinates: beyond it digits are lost

std::string metres(double value) {
  return short_number(std::round(value * 1000.0) / 1000.0);
}

/// The axis from a place on: curvature as a parabola through its values at both ends and in the middle of the stretch.
PlanKnot knot_of(const HorizontalElement& element, double along_m, double length_m) {
  const PlanPoint point = element_point(element, along_m);
  PlanKnot knot;
  knot.length_m = length_m;
  knot.position = point.position;
  knot.tangent = point.tangent();
  knot.curvature_per_m = point.curvature_per_m;
  knot.azimuth_rad = point.azimuth_rad;
  const double change = element.end_curvature_per_m - element.start_curvature_per_m;
  if (element.kind == HorizontalKind::clothoid || change == 0.0) {
    knot.curvature_rate_per_m2 = change / element.length_m;
    return knot;
  }
  const double begin = point.curvature_per_m;
  const double middle = element_point(element, along_m + 0.5 * length_m).curvature_per_m;
  const double end = element_point(element, along_m + length_m).curvature_per_m;
  knot.curvature_rate_per_m2 = (4.0 * middle - 3.0 * begin - end) / length_m;
  knot.curvature_bend_per_m3 = 4.0 * (begin - 2.0 * middle + end) / (length_m * length_m);
  return knot;
}

}  // namespace

HorizontalAlignment::HorizontalAlignment(std::vector<HorizontalElement> elements, double start_chainage_m)
    : elements_(std::move(elements)), start_chainage_m_(start_chainage_m) {
  if (elements_.empty()) throw Error("the plan axis has no elements");
  if (!std::isfinite(start_chainage_m) || std::abs(start_chainage_m) > farthest_m)
    throw Error("the start chainage of the plan axis is not finite or beyond 100,000 km", {}, "write it in metres");
  double length = 0.0;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    check_element(elements_[i], i);
    if (elements_[i].start.cwiseAbs().maxCoeff() > farthest_m)
      throw Error(elements_[i].name + " has a coordinate beyond 100,000 km", {}, "write coordinates in metres");
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
    auto n = static_cast<std::size_t>(std::ceil(element.length_m / stretch));
    if (element.kind == HorizontalKind::biquadratic) n += n % 2;  // its curvature has a corner in the middle
    const double step = element.length_m / static_cast<double>(n);
    first_knot_of_element_.push_back(knots_.size());
    for (std::size_t i = 0; i < n; ++i) {
      const double along = step * static_cast<double>(i);
      knots_.push_back(knot_of(element, along, step));
      knots_.back().chainage_m = element_start + along;
      knots_.back().element = e;
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
