#include "io/landxml_element.h"

#include <cctype>
#include <cmath>

#include "core/foundation/angle.h"
#include "io/text_place.h"

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

void require_clothoid(const LandXmlNode& node, const std::string& name) {
  std::string type = node.text("spiType");
  for (char& c : type) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (type == "clothoid") return;
  node.fail(name + " is of type \"" + node.text("spiType") + "\", which is not supported",
            "have it written as clothoids or as short lines and arcs by whoever made the design");
}

/// Direction at the start from Start and PI; from the chord where PI is absent or of no use.
double spiral_azimuth(const LandXmlNode& node, HorizontalElement spiral, const Eigen::Vector2d& end) {
  const double turn = 0.5 * spiral.length_m * (spiral.start_curvature_per_m + spiral.end_curvature_per_m);
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

void read_spiral(const LandXmlNode& node, LandXmlElement& element) {
  HorizontalElement& spiral = element.geometry;
  require_clothoid(node, spiral.name);
  const double sense = turning_sense(node, spiral.name);
  const double k0 = node.curvature_per_m("radiusStart");
  const double k1 = node.curvature_per_m("radiusEnd");
  if (k0 * k1 < 0.0) node.fail(spiral.name + ": its radii differ in sign", "split it where it is straight");
  spiral.kind = HorizontalKind::clothoid;
  spiral.length_m = node.length_m("length");
  if (spiral.length_m <= 0.0) node.fail(spiral.name + " has no length", "remove it or give its length");
  spiral.start_curvature_per_m = sense * std::abs(k0);
  spiral.end_curvature_per_m = sense * std::abs(k1);
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
