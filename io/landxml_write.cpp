#include <algorithm>
#include <charconv>
#include <cmath>
#include <pugixml.hpp>
#include <sstream>

#include "io/landxml.h"

namespace adit::io {
namespace {

std::string digits(double value) {
  char text[400];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 9).ptr;
  return std::string(text, end);
}

void set(pugi::xml_node node, const char* name, const std::string& value) {
  node.append_attribute(name).set_value(value.c_str());
}

/// "northing easting"
void add_point(pugi::xml_node node, const char* name, const Eigen::Vector2d& east_north) {
  node.append_child(name).text().set((digits(east_north.y()) + " " + digits(east_north.x())).c_str());
}

std::string radius(double curvature_per_m) {
  return curvature_per_m == 0.0 ? "INF" : digits(1.0 / std::abs(curvature_per_m));
}

/// Where the tangents of an element meet.
Eigen::Vector2d intersection(const HorizontalElement& element, const PlanPoint& end) {
  const Eigen::Vector2d t0 = element_point(element, 0.0).tangent();
  const Eigen::Vector2d t1 = end.tangent();
  const Eigen::Vector2d chord = end.position - element.start;
  const double turn = t0.x() * t1.y() - t0.y() * t1.x();
  if (std::abs(turn) < 1e-9) return element.start + 0.5 * element.length_m * t0;
  return element.start + (chord.x() * t1.y() - chord.y() * t1.x()) / turn * t0;
}

HorizontalKind kind_of(const HorizontalElement& element) {
  const double k0 = element.start_curvature_per_m;
  const double k1 = element.end_curvature_per_m;
  if (k0 * k1 < 0.0) {
    throw Error(element.name + " changes its turning sense, which LandXML cannot say", {},
                "split it where it is straight");
  }
  if (k0 != k1) return element.kind;
  return k0 == 0.0 ? HorizontalKind::line : HorizontalKind::arc;
}

void add_element(pugi::xml_node geometry, const HorizontalElement& element, double chainage_m) {
  static constexpr const char* types[] = {"", "", "clothoid", "bloss", "cosine", "sinusoid", "biquadratic", "cubic"};
  const HorizontalKind kind = kind_of(element);
  const bool straight = kind == HorizontalKind::line, arc = kind == HorizontalKind::arc;
  const PlanPoint end = element_point(element, element.length_m);
  pugi::xml_node node = geometry.append_child(straight ? "Line" : arc ? "Curve" : "Spiral");
  set(node, "length", digits(element.length_m));
  set(node, "staStart", digits(chainage_m));
  const double k0 = element.start_curvature_per_m;
  const double k1 = element.end_curvature_per_m;
  if (!straight) set(node, "rot", k0 + k1 > 0.0 ? "cw" : "ccw");
  if (arc) {
    set(node, "crvType", "arc");
    set(node, "radius", radius(k0));
  } else if (!straight) {
    set(node, "spiType", types[static_cast<int>(kind)]);
    set(node, "radiusStart", radius(k0));
    set(node, "radiusEnd", radius(k1));
  }
  add_point(node, "Start", element.start);
  if (arc) {
    add_point(node, "Center", element.start + element_point(element, 0.0).right() / k0);
  }
  if (!straight && !arc) add_point(node, "PI", intersection(element, end));
  add_point(node, "End", end.position);
}

void add_grade_line(pugi::xml_node alignment, const VerticalAlignment& vertical, const std::string& name) {
  static constexpr const char* names[] = {"PVI", "ParaCurve", "UnsymParaCurve", "CircCurve"};
  pugi::xml_node line = alignment.append_child("Profile").append_child("ProfAlign");
  set(line, "name", name);
  for (std::size_t i = 0; i < vertical.points().size(); ++i) {
    const VerticalPoint& point = vertical.points()[i];
    pugi::xml_node node = line.append_child(names[static_cast<int>(point.curve)]);
    const auto extent = vertical.curve_extent(i);
    if (point.curve == VerticalCurveKind::unsymmetrical_parabola) {
      set(node, "lengthIn", digits(point.length_in_m));
      set(node, "lengthOut", digits(point.curve_length_m - point.length_in_m));
    } else if (point.curve != VerticalCurveKind::none) {
      set(node, "length", digits(extent.to_m - extent.from_m));
    }
    if (point.curve == VerticalCurveKind::circle) set(node, "radius", digits(std::abs(point.radius_m)));
    node.text().set((digits(point.chainage_m) + " " + digits(point.elevation_m)).c_str());
  }
}

void add_stations(pugi::xml_node alignment, const StationEquations& stations) {
  for (std::size_t i = 0; i < stations.equations().size(); ++i) {
    const StationEquation& equation = stations.equations()[i];
    pugi::xml_node node = alignment.append_child("StaEquation");
    set(node, "staAhead", digits(equation.ahead_m));
    set(node, "staBack", digits(stations.back_m(i)));
    set(node, "staInternal", digits(equation.chainage_m));
    if (equation.decreasing) set(node, "staIncrement", "decreasing");
  }
}

/// Where all stations turn about; empty when they differ or it is none that LandXML can say.
std::string rotation_point(const Cant& cant) {
  constexpr double same_m = 1e-9;
  const auto all = [&](auto&& holds) { return std::all_of(cant.stations().begin(), cant.stations().end(), holds); };
  if (all([](const CantStation& s) { return std::abs(s.left_m + s.right_m) < same_m; })) return "center";
  if (all([](const CantStation& s) { return std::abs(s.right_m) < same_m; })) return "rightRail";
  if (all([](const CantStation& s) { return std::abs(s.left_m) < same_m; })) return "leftRail";
  const auto at_zero = [](double lower_m) { return std::abs(lower_m) < same_m; };
  if (all([&](const CantStation& s) { return at_zero(std::min(s.left_m, s.right_m)); })) return "insideRail";
  if (all([&](const CantStation& s) { return at_zero(std::max(s.left_m, s.right_m)); })) return "outsideRail";
  return {};
}

void add_cant(pugi::xml_node alignment, const Cant& cant, const std::string& name) {
  static constexpr const char* types[] = {"clothoid", "clothoid", "clothoid",    "bloss",
                                          "cosine",   "sinusoid", "biquadratic", "clothoid"};
  const std::string pivot = rotation_point(cant);
  if (pivot.empty()) throw Error("the cant of " + name + " turns about changing points, which LandXML cannot say");
  pugi::xml_node node = alignment.append_child("Cant");
  set(node, "name", name);
  set(node, "gauge", digits(cant.base_m()));
  set(node, "rotationPoint", pivot);
  for (const CantStation& station : cant.stations()) {
    const double cant_m = station.left_m - station.right_m;
    pugi::xml_node one = node.append_child("CantStation");
    set(one, "station", digits(station.chainage_m));
    set(one, "appliedCant", digits(1000.0 * std::abs(cant_m)));
    set(one, "transitionType", types[static_cast<int>(station.transition)]);
    set(one, "curvature", cant_m < 0.0 ? "ccw" : "cw");
  }
}

}  // namespace

std::string landxml_text(const Alignment& axis) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  pugi::xml_node root = document.append_child("LandXML");
  set(root, "xmlns", "http://www.landxml.org/schema/LandXML-1.2");
  set(root, "version", "1.2");
  set(root, "date", "2000-01-01");  // the schema asks for a date and a time; the same axis gives the same bytes
  set(root, "time", "00:00:00");
  pugi::xml_node units = root.append_child("Units").append_child("Metric");
  for (const auto& [name, value] : {std::pair{"areaUnit", "squareMeter"},
                                    {"linearUnit", "meter"},
                                    {"volumeUnit", "cubicMeter"},
                                    {"temperatureUnit", "celsius"},
                                    {"pressureUnit", "HPA"},
                                    {"angularUnit", "radians"},
                                    {"directionUnit", "radians"}}) {
    set(units, name, value);
  }
  const HorizontalAlignment& plan = axis.horizontal();
  pugi::xml_node alignment = root.append_child("Alignments").append_child("Alignment");
  set(alignment, "name", axis.name());
  set(alignment, "length", digits(plan.to_m() - plan.from_m()));
  set(alignment, "staStart", digits(plan.from_m()));
  add_stations(alignment, axis.stations());
  pugi::xml_node geometry = alignment.append_child("CoordGeom");
  for (std::size_t i = 0; i < plan.elements().size(); ++i) {
    add_element(geometry, plan.elements()[i], plan.element_from_m(i));
  }
  if (!axis.cant().empty()) add_cant(alignment, axis.cant(), axis.name());
  if (!axis.vertical().empty()) add_grade_line(alignment, axis.vertical(), axis.name());
  std::ostringstream text;
  document.save(text, " ");
  return text.str();
}

}  // namespace adit::io
