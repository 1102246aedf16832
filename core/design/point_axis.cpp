#include "core/design/point_axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr double same_place_m = 1e-6;
constexpr double largest_scatter_m = 0.02;
constexpr double refused_advance_m = 0.05;
constexpr double wanted_tangent_rad = 1e-4;  // 1 mm in chainage at a wall 10 m off
constexpr double farthest_neighbour_m = 5.0;

using Points = std::vector<Eigen::Vector2d>;

std::string point_words(std::size_t i) {
  return "point " + std::to_string(i + 1) + " of the axis";
}

/// To the right of a direction.
double right_of(const Eigen::Vector2d& direction, const Eigen::Vector2d& vector) {
  return vector.x() * direction.y() - vector.y() * direction.x();
}

double bend_at(const Points& points, std::size_t i) {
  const Eigen::Vector2d before = points[i] - points[i - 1], behind = points[i + 1] - points[i];
  return std::abs(std::atan2(right_of(before, behind), before.dot(behind)));
}

void check(const Points& points, const std::vector<double>& chainages_m) {
  if (points.size() < 2) throw Error("an axis needs at least two points", {}, "list its points in order of chainage");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || (!chainages_m.empty() && !std::isfinite(chainages_m[i])))
      throw Error(point_words(i) + " holds a number that is not finite");
    if (i == 0) continue;
    if ((points[i] - points[i - 1]).norm() < same_place_m)
      throw Error(point_words(i) + " lies where the one before it does", {}, "remove one of them");
    if (!chainages_m.empty() && chainages_m[i] <= chainages_m[i - 1])
      throw Error(point_words(i) + " has chainage " + short_number(chainages_m[i]) + ", the one before it " +
                      short_number(chainages_m[i - 1]),
                  {}, "list the points in order of chainage");
    if (i + 1 < points.size() && bend_at(points, i) > 0.5 * pi)
      throw Error("the axis turns back at " + point_words(i), {},
                  "list the points in order of chainage; east and north may be swapped in some of them");
  }
}

/// Distance of a point from the cubic through two neighbours on either side, over the length of the chords.
double scatter_at(const Points& points, std::size_t i) {
  double at[5], length = 0.0;
  for (std::size_t k = 0; k < 5; ++k) {
    if (k > 0) length += (points[i + k - 2] - points[i + k - 3]).norm();
    at[k] = length;
  }
  Eigen::Vector2d foretold = Eigen::Vector2d::Zero();
  for (const std::size_t k : {0U, 1U, 3U, 4U}) {
    double weight = 1.0;
    for (const std::size_t other : {0U, 1U, 3U, 4U})
      if (other != k) weight *= (at[2] - at[other]) / (at[k] - at[other]);
    foretold += weight * (points[i + k - 2] - points[i]);
  }
  return foretold.norm();
}

/// Tangent at b of the circle through three points.
Eigen::Vector2d tangent_at_middle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d before = b - a, behind = c - b;
  return (before / before.squaredNorm() + behind / behind.squaredNorm()).normalized();
}

/// Tangents at the knots. At an end the circle through the first three knots goes on.
Points tangents_of(const Points& knots) {
  Points tangents(knots.size());
  const std::size_t last = knots.size() - 1;
  for (std::size_t i = 1; i < last; ++i) tangents[i] = tangent_at_middle(knots[i - 1], knots[i], knots[i + 1]);
  const auto mirrored = [](const Eigen::Vector2d& tangent, const Eigen::Vector2d& chord) -> Eigen::Vector2d {
    const Eigen::Vector2d along = chord.normalized();
    return 2.0 * tangent.dot(along) * along - tangent;
  };
  tangents[0] = last == 1 ? (knots[1] - knots[0]).normalized() : mirrored(tangents[1], knots[1] - knots[0]);
  tangents[last] = last == 1 ? tangents[0] : mirrored(tangents[last - 1], knots[last] - knots[last - 1]);
  return tangents;
}

/// The arc from a place along a tangent to another place; a line when they lie on one.
HorizontalElement arc_to(const Eigen::Vector2d& from, const Eigen::Vector2d& tangent, const Eigen::Vector2d& to) {
  constexpr double straight_per_m = 1e-9;
  const Eigen::Vector2d chord = to - from;
  HorizontalElement element;
  element.start = from;
  element.azimuth_rad = std::atan2(tangent.x(), tangent.y());
  const double curvature = 2.0 * right_of(tangent, chord) / chord.squaredNorm();
  if (std::abs(curvature) < straight_per_m) {
    element.azimuth_rad = std::atan2(chord.x(), chord.y());
    element.length_m = chord.norm();
    return element;
  }
  element.kind = HorizontalKind::arc;
  element.start_curvature_per_m = element.end_curvature_per_m = curvature;
  const double half_turn = std::asin(std::clamp(0.5 * curvature * chord.norm(), -1.0, 1.0));
  element.length_m = 2.0 * half_turn / curvature;
  return element;
}

/// Two arcs with equal tangent lengths that meet both tangents (Bolton, Biarc curves, 1975).
void add_pair_of_arcs(const Eigen::Vector2d& p0, const Eigen::Vector2d& t0, const Eigen::Vector2d& p1,
                      const Eigen::Vector2d& t1, std::vector<HorizontalElement>& elements) {
  const Eigen::Vector2d chord = p1 - p0;
  const double both = chord.dot(t0 + t1);
  const double bend = 2.0 * (1.0 - t0.dot(t1));
  // Written so that nothing is divided by a bend near zero.
  const double d = chord.squaredNorm() / (both + std::sqrt(both * both + bend * chord.squaredNorm()));
  const Eigen::Vector2d joint = 0.5 * (p0 + p1 + d * (t0 - t1));
  elements.push_back(arc_to(p0, t0, joint));
  const Eigen::Vector2d to_joint = joint - p0;
  const Eigen::Vector2d along = to_joint.normalized();
  elements.push_back(arc_to(joint, 2.0 * t0.dot(along) * along - t0, p1));
}

/// Gives the axis between two points the advance in chainage that is stated.
void advance(PointAxis& axis, std::size_t point, double stated_m, std::vector<HorizontalElement>& elements,
             std::size_t first) {
  double length = 0.0;
  for (std::size_t e = first; e < elements.size(); ++e) length += elements[e].length_m;
  const double off = std::abs(stated_m - length);
  if (off > refused_advance_m)
    throw Error("the chainage advances by " + short_number(std::round(stated_m * 1e4) / 1e4) + " m up to " +
                    point_words(point) + ", the points lie " + short_number(std::round(length * 1e4) / 1e4) +
                    " m apart",
                {}, "correct the chainages, or the coordinates");
  if (off > axis.worst_advance_m) {
    axis.worst_advance_m = off;
    axis.worst_advance_at = point;
  }
  for (std::size_t e = first; e < elements.size(); ++e) elements[e].length_m *= stated_m / length;
}

/// Points where the axis bends all at once: more than a degree, and far more than the points around.
std::vector<std::size_t> corners_of(const Points& points) {
  constexpr double least_rad = 0.02, times_others = 4.0;
  constexpr std::size_t around = 4;
  std::vector<std::size_t> corners;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double bend = bend_at(points, i);
    if (bend < least_rad) continue;
    std::vector<double> others;
    for (std::size_t k = i > around ? i - around : 1; k <= i + around && k + 1 < points.size(); ++k)
      if (k != i) others.push_back(bend_at(points, k));
    if (others.empty() || bend > times_others * median(others)) corners.push_back(i);
  }
  return corners;
}

/// A run between corners, on its way to elements.
struct Run {
  std::size_t first, last;
  double scatter_m = 0.0;  ///< median
  double worst_m = 0.0;
  bool smooth = false;
};

Run run_between(const Points& points, std::size_t first, std::size_t last) {
  Run run{first, last};
  std::vector<double> scatters;
  for (std::size_t i = first + 2; i + 2 <= last; ++i) scatters.push_back(scatter_at(points, i));
  if (scatters.empty()) return run;
  run.worst_m = *std::max_element(scatters.begin(), scatters.end());
  run.scatter_m = median(scatters);
  run.smooth = run.worst_m <= largest_scatter_m;
  return run;
}

/// How many points away the neighbours are from which a tangent is taken.
std::size_t reach_of(const Points& points, const Run& run) {
  double length = 0.0;
  for (std::size_t i = run.first + 1; i <= run.last; ++i) length += (points[i] - points[i - 1]).norm();
  const double spacing = length / static_cast<double>(run.last - run.first);
  const double wanted = std::min(run.scatter_m / wanted_tangent_rad, farthest_neighbour_m);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(wanted / spacing)));
}

/// The points that the pieces of a run meet: both ends, and between them each one, or each so many where points
/// scatter.
std::vector<std::size_t> knots_of(const Points& points, const Run& run) {
  const std::size_t reach = run.smooth ? reach_of(points, run) : 1;
  std::vector<std::size_t> knots;
  for (std::size_t i = run.first; i < run.last; i += reach) knots.push_back(i);
  if (knots.size() > 1 && run.last - knots.back() < reach) knots.pop_back();
  knots.push_back(run.last);
  return knots;
}

/// Chainages of points that came with none: those of their feet.
std::vector<double> feet_of(const Points& points, const std::vector<std::size_t>& knots,
                            const std::vector<double>& knot_chainages_m, const HorizontalAlignment& horizontal) {
  std::vector<double> chainages;
  double along = 0.0;  // length of the chords since the knot before
  for (std::size_t i = 0, k = 0; i < points.size(); ++i) {
    if (k < knots.size() && i == knots[k]) {  // the axis goes through it
      chainages.push_back(knot_chainages_m[k++]);
      along = 0.0;
      continue;
    }
    along += (points[i] - points[i - 1]).norm();
    const auto foot = horizontal.foot(points[i], knot_chainages_m[k - 1] + along);
    if (!foot || (i > 0 && foot->chainage_m <= chainages.back()))
      throw Error("the axis turns back at " + point_words(i), {}, "list the points in order of chainage");
    chainages.push_back(foot->chainage_m);
  }
  return chainages;
}

/// The elements of a run; `visit(knot, first element)` is called after those up to each knot.
template <typename Visit>
void add_run(const Points& points, const Run& run, std::vector<HorizontalElement>& elements, const Visit& visit) {
  const std::vector<std::size_t> knots = knots_of(points, run);
  Points places;
  for (const std::size_t i : knots) places.push_back(points[i]);
  const Points tangents = run.smooth ? tangents_of(places) : Points{};
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const std::size_t first = elements.size();
    if (run.smooth)
      add_pair_of_arcs(places[k - 1], tangents[k - 1], places[k], tangents[k], elements);
    else
      elements.push_back(arc_to(places[k - 1], (places[k] - places[k - 1]).normalized(), places[k]));
    visit(knots[k], first);
  }
}

void take_note_of(const Points& points, const Run& run, PointAxis& axis) {
  axis.worst_scatter_m = std::max(axis.worst_scatter_m, run.worst_m);
  axis.scatter_m = std::max(axis.scatter_m, run.scatter_m);
  if (run.smooth) return;
  if (run.last - run.first >= 2) axis.smooth = false;  // it may bend between its ends
  for (std::size_t i = run.first + 1; i < run.last; ++i)
    axis.sharpest_bend_rad = std::max(axis.sharpest_bend_rad, bend_at(points, i));
}

}  // namespace

PointAxis axis_through(const Points& points, const std::vector<double>& chainages_m, double start_chainage_m) {
  check(points, chainages_m);
  PointAxis axis;
  axis.smooth = true;
  axis.corners = corners_of(points);
  for (const std::size_t i : axis.corners)
    axis.sharpest_bend_rad = std::max(axis.sharpest_bend_rad, bend_at(points, i));
  std::vector<HorizontalElement> elements;
  std::vector<std::size_t> knots{0};
  std::vector<double> knot_chainages{chainages_m.empty() ? start_chainage_m : chainages_m.front()};
  const auto reached = [&](std::size_t knot, std::size_t first) {
    if (!chainages_m.empty()) advance(axis, knot, chainages_m[knot] - chainages_m[knots.back()], elements, first);
    double length = 0.0;
    for (std::size_t e = first; e < elements.size(); ++e) {
      elements[e].name = "the piece up to " + point_words(knot);
      length += elements[e].length_m;
    }
    knots.push_back(knot);
    knot_chainages.push_back(knot_chainages.back() + length);
  };
  std::size_t first = 0;
  for (std::size_t c = 0; c <= axis.corners.size(); ++c) {
    const std::size_t last = c < axis.corners.size() ? axis.corners[c] : points.size() - 1;
    const Run run = run_between(points, first, last);
    take_note_of(points, run, axis);
    add_run(points, run, elements, reached);
    first = last;
  }
  axis.horizontal = HorizontalAlignment(std::move(elements), knot_chainages.front());
  axis.chainages_m = chainages_m.empty() ? feet_of(points, knots, knot_chainages, axis.horizontal) : chainages_m;
  return axis;
}

}  // namespace adit
