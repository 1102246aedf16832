#include "io/landxml_element.h"

#include <algorithm>
#include <cmath>

#include "core/design/transition_curve.h"
#include "core/foundation/angle.h"
#include "io/text_place.h"
#include "io/transition_names.h"

namespace adit::io {
namespace {

constexpr double nothing_m = 1e-6;
constexpr double wrong_by_m = 0.05;

double azimuth(const Eigen::Vector2d& direction) {
  return std::atan2(direction.x(), direction.y());
}

/// +1 for "cw" (a right-hand turn), -1 for "ccw".
double turning_sense(const LandXmlNode& node, const std::string& name) {
  const std::string rot = node.text("rot");
  if (rot == "cw") return 1.0;
  if (rot == "ccw") return -1.0;
  node.fail(name + ": rot is \"" + rot + "\"", "write cw or ccw");
}

[[noreturn]] void refuse_turning_sense(const LandXmlNode& node, const std::string& name) {
  node.fail(name + " turns the other way than rot=\"" + node.text("rot") + "\" says",
            "write points as northing easting (they may be swapped), or correct rot");
}

bool has_no_length(const LandXmlElement& element) {
  const bool stated_none = !element.stated_length_m || std::abs(*element.stated_length_m) < 1e-3;
  return stated_none && (element.stated_end - element.geometry.start).norm() < 1e-3;
}

void read_line(LandXmlElement& element) {
  HorizontalElement& line = element.geometry;
  const Eigen::Vector2d chord = element.stated_end - line.start;
  line.kind = HorizontalKind::line;
  line.azimuth_rad = azimuth(chord);
  line.length_m = chord.norm() < nothing_m ? 0.0 : chord.norm();
}

void read_curve(const LandXmlNode& node, LandXmlElement& element) {
  HorizontalElement& arc = element.geometry;
  const Eigen::Vector2d centre = node.point_m("Center");
  const Eigen::Vector2d from_centre = arc.start - centre;
  const double radius = from_centre.norm();
  const double sense = turning_sense(node, arc.name);
  if (radius < nothing_m) node.fail(arc.name + ": its Center is its Start", "export the arc again");
  element.stated_radius_m = node.optional_length_m("radius");
  double sweep = sense * (azimuth(element.stated_end - centre) - azimuth(from_centre));
  sweep -= 2.0 * pi * std::floor(sweep / (2.0 * pi));
  const auto differs = [&](double angle) { return std::abs(radius * angle - *element.stated_length_m); };
  if (element.stated_length_m) {
    // A full circle has no sweep between its points.
    if (differs(sweep + 2.0 * pi) < differs(sweep)) sweep += 2.0 * pi;
    if (differs(sweep) > wrong_by_m && differs(2.0 * pi - sweep) < wrong_by_m) refuse_turning_sense(node, arc.name);
  }
  arc.kind = HorizontalKind::arc;
  arc.azimuth_rad = azimuth(from_centre) + sense * 0.5 * pi;
  arc.start_curvature_per_m = arc.end_curvature_per_m = sense / radius;
  arc.length_m = radius * sweep;
}

HorizontalKind transition(const LandXmlNode& node, const std::string& name) {
  const auto kind = landxml_transition(node.text("spiType"));
  if (!kind)
    node.fail(name + " is of type \"" + node.text("spiType") + "\", which is not supported",
              "have it written as clothoids, Bloss, cosine, sinusoid or cubic curves by whoever made the design");
  return *kind;
}

/// Direction at the start from Start and PI; from the chord where PI is absent or of no use.
double spiral_azimuth(const LandXmlNode& node, HorizontalElement spiral, const Eigen::Vector2d& end) {
  const double turn = element_point(spiral, spiral.length_m).azimuth_rad - spiral.azimuth_rad;
  const auto pi_point = node.optional_point_m("PI");
  constexpr double largest_turn = 0.95 * pi;  // beyond half a turn the tangents meet behind the start
  constexpr double shortest_tangent_m = 0.01;
  if (pi_point && std::abs(turn) < largest_turn && (*pi_point - spiral.start).norm() > shortest_tangent_m) {
    return azimuth(*pi_point - spiral.start);
  }
  spiral.azimuth_rad = 0.0;
  const Eigen::Vector2d chord = element_point(spiral, spiral.length_m).position - spiral.start;
  return azimuth(end - spiral.start) - azimuth(chord);
}

/// Programs write y = x^3 / (6 R X), / (6 R L), or such that the radius is met exactly. Between a straight and a curve
/// its points tell which one: y'' at the curved end is 6 y / x^2. The length along it follows.
void fit_parabola(const LandXmlNode& node, LandXmlElement& element) {
  constexpr double most_off = 0.005;  // of the curvature
  HorizontalElement& spiral = element.geometry;
  const bool from_straight = spiral.start_curvature_per_m == 0.0, to_straight = spiral.end_curvature_per_m == 0.0;
  const auto corner = node.optional_point_m("PI");
  if (from_straight == to_straight || !corner) return;
  const Eigen::Vector2d straight_end = from_straight ? spiral.start : element.stated_end;
  const Eigen::Vector2d curved_end = from_straight ? element.stated_end : spiral.start;
  const Eigen::Vector2d ahead = (*corner - straight_end).normalized();
  const Eigen::Vector2d chord = curved_end - straight_end;
  const double x = chord.dot(ahead);
  const double y = chord.x() * ahead.y() - chord.y() * ahead.x();  // to the right
  double& curvature = from_straight ? spiral.end_curvature_per_m : spiral.start_curvature_per_m;
  const double fitted = std::copysign(6.0 * y / (x * x), curvature);
  const double length_m = parabola_length_m(x, fitted);
  const double true_share = std::pow(1.0 + 0.25 * fitted * fitted * x * x, -1.5);
  const auto is_stated = [&](double meant) { return std::abs(meant - curvature) <= most_off * std::abs(curvature); };
  if (!(x > 0.0) || !(is_stated(fitted) || is_stated(fitted * length_m / x) || is_stated(fitted * true_share)))
    node.fail(spiral.name + ": its points are not those of a cubic parabola of its radius",
              "correct radius and points, or have it written as another transition");
  curvature = fitted;
  spiral.length_m = length_m;
}

void read_spiral(const LandXmlNode& node, LandXmlElement& element) {
  HorizontalElement& spiral = element.geometry;
  spiral.kind = transition(node, spiral.name);
  const double sense = turning_sense(node, spiral.name);
  const double k0 = node.curvature_per_m("radiusStart");
  const double k1 = node.curvature_per_m("radiusEnd");
  if (k0 * k1 < 0.0) node.fail(spiral.name + ": its radii differ in sign", "split it where it is straight");
  spiral.length_m = node.length_m("length");
  if (spiral.length_m <= 0.0) node.fail(spiral.name + " has no length", "remove it or give its length");
  spiral.start_curvature_per_m = sense * std::abs(k0);
  spiral.end_curvature_per_m = sense * std::abs(k1);
  constexpr double most_turns_rad = 20.0 * pi;  // before anything is integrated
  if (std::max(std::abs(k0), std::abs(k1)) * spiral.length_m > most_turns_rad)
    node.fail(spiral.name + " turns by more than ten circles", "check its length, radii and unit");
  if (spiral.kind == HorizontalKind::cubic_parabola) fit_parabola(node, element);
  spiral.azimuth_rad = spiral_azimuth(node, spiral, element.stated_end);

  const auto gap = [&](const HorizontalElement& e) {
    return (element_point(e, e.length_m).position - element.stated_end).norm();
  };
  if (gap(spiral) <= wrong_by_m) return;
  HorizontalElement mirrored = spiral;
  mirrored.start_curvature_per_m *= -1.0;
  mirrored.end_curvature_per_m *= -1.0;
  if (gap(mirrored) < wrong_by_m) refuse_turning_sense(node, spiral.name);
}

}  // namespace

LandXmlElement read_landxml_element(const LandXmlNode& node, const std::string& name) {
  LandXmlElement element;
  element.place = node.place();
  element.geometry.name = name;
  element.geometry.start = node.point_m("Start");
  element.stated_end = node.point_m("End");
  element.stated_length_m = node.optional_length_m("length");
  const std::string kind = node.name();
  element.stated_start_dir = node.optional_number(kind == "Line" ? "dir" : "dirStart");
  if (has_no_length(element)) return element;
  if (kind == "Line") {
    read_line(element);
  } else if (kind == "Curve") {
    read_curve(node, element);
  } else {
    read_spiral(node, element);
  }
  return element;
}

}  // namespace adit::io
