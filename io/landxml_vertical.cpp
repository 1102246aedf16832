#include "io/landxml_vertical.h"

#include <cmath>
#include <utility>
#include <vector>

#include "core/foundation/options.h"

namespace adit::io {
namespace {

constexpr double reported_length_m = 0.01;

std::string metres(double value) {
  return short_number(std::round(value * 1e4) / 1e4);
}

VerticalPoint read_point(const LandXmlNode& node, const std::string& subject) {
  const std::string kind = node.name();
  const std::vector<double> values = node.numbers(2);
  VerticalPoint point;
  point.chainage_m = values[0] * node.units().metres_per_unit;
  point.elevation_m = values[1] * node.units().elevation_metres_per_unit;
  if (kind == "PVI") return point;
  if (kind == "ParaCurve") {
    point.curve = VerticalCurveKind::parabola;
    point.curve_length_m = node.length_m("length");
  } else if (kind == "UnsymParaCurve") {
    point.curve = VerticalCurveKind::unsymmetrical_parabola;
    point.length_in_m = node.length_m("lengthIn");
    point.curve_length_m = point.length_in_m + node.length_m("lengthOut");
  } else if (kind == "CircCurve") {
    point.curve = VerticalCurveKind::circle;
    point.radius_m = std::abs(node.length_m("radius"));  // some write a sign, some do not: the grades decide
    point.curve_length_m = node.optional_length_m("length").value_or(0.0);
  } else {
    node.fail(kind + " at chainage " + metres(point.chainage_m) + " of " + subject + " is not supported",
              "replace it by ParaCurve, UnsymParaCurve or CircCurve");
  }
  return point;
}

/// Compares the stated lengths of circles with the lengths along the arc and in plan that their radii give.
void check_lengths(const VerticalAlignment& vertical, const std::string& subject, Findings& findings) {
  for (std::size_t i = 0; i < vertical.points().size(); ++i) {
    const VerticalPoint& point = vertical.points()[i];
    if (point.curve != VerticalCurveKind::circle || point.curve_length_m <= 0.0) continue;
    const auto extent = vertical.curve_extent(i);
    const double in_plan = extent.to_m - extent.from_m;
    const double slopes = std::atan(vertical.at(extent.to_m).grade) - std::atan(vertical.at(extent.from_m).grade);
    const double along = point.radius_m * std::abs(slopes);
    const double stated = point.curve_length_m;
    if (std::abs(stated - in_plan) < reported_length_m || std::abs(stated - along) < reported_length_m) continue;
    findings.push_back({Severity::warning, subject + ", vertical curve at chainage " + metres(point.chainage_m),
                        "the file states a length of " + metres(stated) + " m, its radius of " +
                            metres(point.radius_m) + " m gives " + metres(in_plan) + " m",
                        "the radius is used"});
  }
}

}  // namespace

LandXmlGrade read_landxml_grade(const LandXmlNode& alignment, const std::string& subject) {
  std::vector<LandXmlNode> lines;
  LandXmlGrade grade;
  for (const LandXmlNode& profile : alignment.children("Profile")) {
    for (const LandXmlNode& line : profile.children("ProfAlign")) lines.push_back(line);
    const std::string unread = unread_children(profile, {"ProfAlign"});
    if (!unread.empty()) grade.findings.push_back({Severity::note, subject, "not honoured in Profile: " + unread, ""});
  }
  if (lines.empty()) return grade;
  if (lines.size() > 1) {
    lines[1].fail(subject + " has " + std::to_string(lines.size()) + " grade lines",
                  "leave the one that is to be built");
  }
  std::vector<VerticalPoint> points;
  for (const LandXmlNode& node : lines.front().children()) {
    if (node.name() != "Feature") points.push_back(read_point(node, subject));
  }
  try {
    grade.vertical = VerticalAlignment(std::move(points));
  } catch (const Error& error) {
    throw Error(subject + ": " + error.what_is_wrong(), lines.front().place(), error.mend());
  }
  check_lengths(grade.vertical, subject, grade.findings);
  return grade;
}

}  // namespace adit::io
