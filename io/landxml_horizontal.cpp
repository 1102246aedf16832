#include "io/landxml_horizontal.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/foundation/angle.h"
#include "core/foundation/options.h"
#include "io/landxml_element.h"
#include "io/landxml_polyline.h"

namespace adit::io {
namespace {

constexpr double reported_gap_m = 1e-3;
constexpr double refused_gap_m = 0.05;
constexpr double reported_kink_rad = 2e-4;  // 2 mm at a wall 10 m off
constexpr double reported_direction_rad = 1e-3;

std::string millimetres(double metres) {
  return short_number(std::round(metres * 1e4) / 10.0) + " mm";
}
std::string metres(double value) {
  return short_number(std::round(value * 1e4) / 1e4) + " m";
}

struct Elements {
  std::vector<LandXmlElement> list;
  Findings findings;
};

/// Its pieces, and how much they bend where they meet.
void add_polyline(const LandXmlNode& node, const std::string& name, const std::string& subject, Elements& elements) {
  const std::vector<LandXmlElement> pieces = read_landxml_polyline(node, name);
  double sharpest_rad = 0.0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const double bend = wrapped_rad(pieces[i].geometry.azimuth_rad - pieces[i - 1].geometry.azimuth_rad);
    sharpest_rad = std::max(sharpest_rad, std::abs(bend));
  }
  elements.list.insert(elements.list.end(), pieces.begin(), pieces.end());
  if (sharpest_rad < reported_kink_rad) return;
  elements.findings.push_back({Severity::warning, subject + ", " + name,
                               "is " + std::to_string(pieces.size()) + " straight pieces, which bend by up to " +
                                   short_number(std::round(deg_from_rad(sharpest_rad) * 1e4) / 1e4) + " degrees",
                               "offsets jump there; ask for the curves it stands for"});
}

/// Elements in order, those without length left out and listed.
Elements read_elements(const LandXmlNode& alignment, const std::string& subject) {
  Elements elements;
  int number = 0;
  for (const LandXmlNode& geometry : alignment.children("CoordGeom")) {
    for (const LandXmlNode& node : geometry.children()) {
      const std::string kind = node.name();
      if (kind == "Feature") continue;
      const std::string name = kind + " " + std::to_string(++number);
      if (kind == "IrregularLine" || kind == "Chain") {
        add_polyline(node, name, subject, elements);
        continue;
      }
      if (kind != "Line" && kind != "Curve" && kind != "Spiral") {
        node.fail(name + " of " + subject + " is not supported", "replace it by lines, arcs and clothoids");
      }
      LandXmlElement element = read_landxml_element(node, name);
      if (element.geometry.length_m > 0.0) {
        elements.list.push_back(std::move(element));
      } else {
        elements.findings.push_back({Severity::note, subject + ", " + name, "has no length and is left out", ""});
      }
    }
  }
  if (!elements.list.empty()) return elements;
  const bool has_points = alignment.child("AlignPIs").has_value();
  alignment.fail(
      subject + " has no plan geometry" + (has_points ? ": it gives points of intersection (AlignPIs) only" : ""),
      "export it with CoordGeom");
}

/// The gap between the computed end of an element and the file's End, or the next element's Start.
void check_gaps(const LandXmlElement& element, const LandXmlElement* next, const std::string& subject,
                Findings& findings) {
  const Eigen::Vector2d end = element.computed_end().position;
  const std::string name = subject + ", " + element.geometry.name;
  std::vector<std::pair<double, std::string>> gaps{{(end - element.stated_end).norm(), "the End the file gives"}};
  if (next != nullptr) gaps.emplace_back((end - next->geometry.start).norm(), "the Start of " + next->geometry.name);
  std::string words;
  for (const auto& [gap, what] : gaps) {
    if (gap > refused_gap_m) {
      throw Error(name + ": its computed end lies " + metres(gap) + " from " + what, element.place,
                  "correct the element; points are northing easting");
    }
    if (gap > reported_gap_m) words += (words.empty() ? "" : " and ") + millimetres(gap) + " from " + what;
  }
  if (!words.empty()) {
    findings.push_back(
        {Severity::warning, name, "its computed end lies " + words, "ask for an exact export of the axis"});
  }
}

/// Warns of kinks; refuses an axis that turns back, as one with swapped coordinates does.
void check_kink(const LandXmlElement& element, const LandXmlElement& next, const std::string& subject,
                Findings& findings) {
  const double kink = std::abs(wrapped_rad(next.geometry.azimuth_rad - element.computed_end().azimuth_rad));
  if (kink > 0.5 * pi) {
    throw Error(subject + " turns back by " + short_number(std::round(deg_from_rad(kink))) + " degrees between " +
                    element.geometry.name + " and " + next.geometry.name,
                next.place, "write points as northing easting (they may be swapped) and elements in order of chainage");
  }
  const bool inside_polyline = element.of_polyline && next.of_polyline && element.place == next.place;
  if (kink < reported_kink_rad || inside_polyline) return;
  findings.push_back({Severity::warning, subject + ", " + next.geometry.name,
                      "its direction differs from the end of " + element.geometry.name + " by " +
                          short_number(std::round(deg_from_rad(kink) * 1e4) / 1e4) + " degrees",
                      "offsets jump there; ask whether the kink is meant"});
}

void check_lengths(const LandXmlElement& element, const std::string& subject, Findings& findings) {
  const std::string name = subject + ", " + element.geometry.name;
  const double length = element.geometry.length_m;
  if (element.stated_length_m && std::abs(*element.stated_length_m - length) > reported_gap_m) {
    findings.push_back(
        {Severity::warning, name,
         "the file states a length of " + metres(*element.stated_length_m) + ", its points give " + metres(length),
         "the points are used"});
  }
  if (!element.stated_radius_m) return;
  const double radius = 1.0 / std::abs(element.geometry.start_curvature_per_m);
  if (std::abs(std::abs(*element.stated_radius_m) - radius) > reported_gap_m) {
    findings.push_back(
        {Severity::warning, name,
         "the file states a radius of " + metres(*element.stated_radius_m) + ", its centre gives " + metres(radius),
         "the centre is used"});
  }
}

/// How the directions of the elements agree with their points.
struct DirectionCheck {
  std::string first_from_north_differing;
  int from_north_differing = 0;
  int from_east_differing = 0;
  bool has_curves = false;
};

DirectionCheck compare_directions(const std::vector<LandXmlElement>& elements, const LandXmlUnits& units) {
  DirectionCheck check;
  for (const LandXmlElement& element : elements) {
    check.has_curves |= element.geometry.kind != HorizontalKind::line;
    if (!element.stated_start_dir) continue;
    const double stated = units.direction_rad(*element.stated_start_dir);
    const double azimuth = element.geometry.azimuth_rad;
    const auto differs = [&](double angle) { return std::abs(wrapped_rad(stated - angle)) > reported_direction_rad; };
    if (differs(0.5 * pi - azimuth)) ++check.from_east_differing;
    if (!differs(azimuth) || !differs(-azimuth)) continue;  // with or against the clock
    if (check.from_north_differing++ == 0) check.first_from_north_differing = element.geometry.name;
  }
  return check;
}

/// Directions may count from north with or against the clock, or from east against it. The last looks the same as
/// swapped coordinates, which only the turning sense of a curve excludes.
void check_directions(const std::vector<LandXmlElement>& elements, const LandXmlUnits& units,
                      const std::string& subject, Findings& findings) {
  if (!units.direction) {
    findings.push_back({Severity::note, subject, "the unit of its directions is unknown; they are not checked", ""});
    return;
  }
  const DirectionCheck check = compare_directions(elements, units);
  if (check.from_north_differing == 0 || (check.from_east_differing == 0 && check.has_curves)) return;
  if (check.from_east_differing == 0) {
    findings.push_back({Severity::warning, subject,
                        "the directions of its lines fit coordinates written easting northing, not northing easting",
                        "make sure that the coordinates are not swapped"});
    return;
  }
  findings.push_back({Severity::note, subject,
                      "the directions of " + std::to_string(check.from_north_differing) + " elements, first " +
                          check.first_from_north_differing + ", differ from their points",
                      "the points are used"});
}

}  // namespace

LandXmlPlan read_landxml_plan(const LandXmlNode& alignment, const std::string& subject) {
  Elements elements = read_elements(alignment, subject);
  const double start_chainage = alignment.length_m("staStart");
  std::vector<HorizontalElement> geometry;
  for (std::size_t i = 0; i < elements.list.size(); ++i) {
    const LandXmlElement& element = elements.list[i];
    const LandXmlElement* next = i + 1 < elements.list.size() ? &elements.list[i + 1] : nullptr;
    if (next != nullptr) check_kink(element, *next, subject, elements.findings);
    check_gaps(element, next, subject, elements.findings);
    check_lengths(element, subject, elements.findings);
    geometry.push_back(element.geometry);
  }
  check_directions(elements.list, alignment.units(), subject, elements.findings);
  try {
    return {HorizontalAlignment(std::move(geometry), start_chainage), std::move(elements.findings)};
  } catch (const Error& error) {
    throw Error(subject + ": " + error.what_is_wrong(), alignment.place(), error.mend());
  }
}

}  // namespace adit::io
