#include "io/ifc_segments.h"

#include <cmath>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/options.h"
#include "io/text_place.h"
#include "io/transition_names.h"

namespace adit::io {
namespace {

constexpr double reported_gap_m = 1e-3;
constexpr double refused_gap_m = 0.05;
constexpr double reported_kink_rad = 2e-4;
constexpr double nothing_m = 1e-6;

std::string millimetres(double metres) {
  return short_number(std::round(metres * 1e4) / 10.0) + " mm";
}

HorizontalKind plan_kind(const IfcInstance& segment, const std::string& name) {
  const std::string kind = segment.word_at(8);
  if (kind == "LINE") return HorizontalKind::line;
  if (kind == "CIRCULARARC") return HorizontalKind::arc;
  if (kind == "CLOTHOID") return HorizontalKind::clothoid;
  if (const auto transition = ifc_transition(kind)) return *transition;
  if (kind == "CUBIC") return HorizontalKind::cubic_parabola;
  segment.fail(name + " is of type " + quoted_word(kind) + ", which is not supported",
               "have it written as clothoids, Bloss, cosine or sine curves by whoever made the design");
}

/// IFC: positive to the left, 0 for none.
double curvature_of(double radius_m) {
  return radius_m == 0.0 ? 0.0 : -1.0 / radius_m;
}

HorizontalElement plan_element(const IfcText& text, const IfcInstance& segment, const std::string& name,
                               const IfcUnits& units, const IfcFrame& frame) {
  const IfcInstance& point = text.at(segment.reference_at(2), segment);
  const std::vector<double> place = point.numbers_at(0);
  if (place.size() < 2) point.fail("a point needs two coordinates", "export the file again");
  HorizontalElement element;
  element.name = name;
  element.kind = plan_kind(segment, name);
  element.start = frame.plan(units.metres_per_unit * Eigen::Vector2d(place[0], place[1]));
  element.azimuth_rad = 0.5 * pi - (segment.number_at(3) * units.radians_per_unit + frame.turn_rad);
  element.length_m = segment.number_at(6) * units.metres_per_unit;
  if (element.kind == HorizontalKind::line) return element;
  element.start_curvature_per_m = curvature_of(segment.number_at(4) * units.metres_per_unit);
  element.end_curvature_per_m = element.kind == HorizontalKind::arc
                                    ? element.start_curvature_per_m
                                    : curvature_of(segment.number_at(5) * units.metres_per_unit);
  if (element.kind == HorizontalKind::arc && segment.number_or(5, segment.number_at(4)) != segment.number_at(4))
    segment.fail(name + " is an arc with two radii", "write it as a clothoid, or correct the radius");
  if (element.kind == HorizontalKind::arc && element.start_curvature_per_m == 0.0)
    segment.fail(name + " is an arc without radius", "correct it, or write it as a line");
  return element;
}

/// Where an element ends against where the next one starts.
void check_joint(const HorizontalElement& element, const HorizontalElement& next, const std::string& place,
                 const std::string& subject, Findings& findings) {
  const PlanPoint end = element_point(element, element.length_m);
  const double gap = (end.position - next.start).norm();
  const double kink = std::abs(wrapped_rad(next.azimuth_rad - end.azimuth_rad));
  if (gap > refused_gap_m)
    throw Error(element.name + " ends " + millimetres(gap) + " from the start of " + next.name, place,
                "correct the segment");
  if (kink > 0.5 * pi)
    throw Error("the axis turns back between " + element.name + " and " + next.name, place,
                "list segments in order of chainage");
  if (gap > reported_gap_m)
    findings.push_back({Severity::warning, subject + ", " + element.name,
                        "its computed end lies " + millimetres(gap) + " from the start of " + next.name,
                        "ask for an exact export of the axis"});
  if (kink > reported_kink_rad)
    findings.push_back({Severity::warning, subject + ", " + next.name,
                        "its direction differs from the end of " + element.name + " by " +
                            short_number(std::round(deg_from_rad(kink) * 1e4) / 1e4) + " degrees",
                        "offsets jump there; ask whether the kink is meant"});
}

/// A vertical segment in metres.
struct GradeSegment {
  const IfcInstance* from = nullptr;
  std::string name;
  VerticalCurveKind kind = VerticalCurveKind::none;
  double chainage_m = 0.0, length_m = 0.0, elevation_m = 0.0, grade_in = 0.0, grade_out = 0.0, radius_m = 0.0;

  /// Plan length and rise from the start to the point where both grades meet, and from there to the end.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> tangents() const {
    if (kind != VerticalCurveKind::circle) {
      const double half_m = 0.5 * length_m;
      return {{half_m, half_m * grade_in}, {half_m, half_m * grade_out}};
    }
    const double in = std::atan(grade_in), out = std::atan(grade_out);
    const double tangent_m = std::abs(radius_m) * std::tan(0.5 * std::abs(out - in));
    return {tangent_m * Eigen::Vector2d(std::cos(in), std::sin(in)),
            tangent_m * Eigen::Vector2d(std::cos(out), std::sin(out))};
  }
};

GradeSegment grade_segment(const IfcInstance& segment, const std::string& name, const IfcUnits& units, double height_m,
                           double start_chainage_m) {
  GradeSegment read;
  read.from = &segment;
  read.name = name;
  read.chainage_m = start_chainage_m + segment.number_at(2) * units.metres_per_unit;
  read.length_m = segment.number_at(3) * units.metres_per_unit;
  read.elevation_m = height_m + segment.number_at(4) * units.metres_per_unit;
  read.grade_in = segment.number_at(5);
  read.grade_out = segment.number_at(6);
  const std::string kind = segment.word_at(8);
  if (kind == "PARABOLICARC") {
    read.kind = VerticalCurveKind::parabola;
  } else if (kind == "CIRCULARARC") {
    read.kind = VerticalCurveKind::circle;
    read.radius_m = segment.number_at(7) * units.metres_per_unit;
    const auto [in, out] = read.tangents();
    if (std::abs(in.x() + out.x() - read.length_m) > refused_gap_m)
      segment.fail(name + ": its radius and its grades give a length of " + short_number(in.x() + out.x()) +
                       " m, it states " + short_number(read.length_m) + " m",
                   "correct the segment");
  } else if (kind != "CONSTANTGRADIENT") {
    segment.fail(name + " is of type " + quoted_word(kind) + ", which is not supported",
                 "replace it by grades, parabolas and circles");
  }
  if (read.grade_in == read.grade_out) read.kind = VerticalCurveKind::none;
  return read;
}

HorizontalKind cant_transition(const IfcInstance& segment) {
  const std::string kind = segment.word_at(8);
  if (kind == "CONSTANTCANT" || kind == "LINEARTRANSITION") return HorizontalKind::clothoid;
  if (const auto transition = ifc_transition(kind)) return *transition;
  segment.fail("a cant segment is of type " + quoted_word(kind) + ", which is not supported",
               "have it written as linear, Bloss, cosine or sine transitions by whoever made the design");
}

}  // namespace

HorizontalAlignment plan_of(const IfcText& text, const IfcSegments& segments, const IfcUnits& units,
                            const IfcFrame& frame, double start_chainage_m, const std::string& subject,
                            Findings& findings) {
  std::vector<HorizontalElement> elements;
  std::string place;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const std::string name = "segment " + std::to_string(i + 1);
    HorizontalElement element = plan_element(text, *segments[i], name, units, frame);
    if (element.length_m < 0.0) segments[i]->fail(name + " has a negative length", "correct the segment");
    if (element.length_m > 0.0) check_element(element, i);
    if (!elements.empty()) check_joint(elements.back(), element, segments[i]->place, subject, findings);
    if (std::abs(element.length_m) < nothing_m) continue;  // 4.3 closes an alignment with a segment of no length
    elements.push_back(std::move(element));
  }
  return HorizontalAlignment(std::move(elements), start_chainage_m);
}

VerticalAlignment grade_of(const IfcSegments& segments, const IfcUnits& units, double height_m, double start_chainage_m,
                           const std::string& subject, Findings& findings) {
  std::vector<VerticalPoint> points;
  double end_m = 0.0, end_elevation_m = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const GradeSegment segment =
        grade_segment(*segments[i], "vertical segment " + std::to_string(i + 1), units, height_m, start_chainage_m);
    if (i > 0) {
      const double gap = std::hypot(segment.chainage_m - end_m, segment.elevation_m - end_elevation_m);
      if (gap > refused_gap_m)
        segment.from->fail(segment.name + " starts " + millimetres(gap) + " from the end of the one before it",
                           "correct the segment");
      if (gap > reported_gap_m)
        findings.push_back({Severity::warning, subject + ", " + segment.name,
                            "it starts " + millimetres(gap) + " from the end of the one before it",
                            "ask for an exact export of the axis"});
    }
    if (segment.length_m < nothing_m) continue;
    points.push_back({segment.chainage_m, segment.elevation_m});
    const auto [in, out] = segment.tangents();
    if (segment.kind != VerticalCurveKind::none)
      points.push_back({segment.chainage_m + in.x(), segment.elevation_m + in.y(), segment.kind, segment.length_m,
                        std::abs(segment.radius_m)});
    end_m = segment.chainage_m + segment.length_m;
    end_elevation_m = segment.elevation_m + in.y() + out.y();
    if (segment.kind == VerticalCurveKind::none)
      end_elevation_m = segment.elevation_m + segment.length_m * segment.grade_in;
  }
  if (points.empty()) return {};
  points.push_back({end_m, end_elevation_m});
  return VerticalAlignment(std::move(points));
}

Cant cant_of(const IfcSegments& segments, const IfcUnits& units, double base, double start_chainage_m) {
  const double metres = units.metres_per_unit;
  std::vector<CantStation> stations;
  for (const IfcInstance* segment : segments) {
    const double from_m = start_chainage_m + segment->number_at(2) * metres;
    const double left = segment->number_at(4) * metres, right = segment->number_at(6) * metres;
    stations.push_back({from_m, left, right, cant_transition(*segment)});
    const double length_m = segment->number_at(3) * metres;
    if (length_m < nothing_m) continue;
    stations.push_back({from_m + length_m, segment->number_or(5, left / metres) * metres,
                        segment->number_or(7, right / metres) * metres});
  }
  return Cant(std::move(stations), base * metres);
}

}  // namespace adit::io
