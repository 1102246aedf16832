#include "io/landxml_cant.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/foundation/options.h"
#include "io/character_set.h"
#include "io/text_place.h"
#include "io/transition_names.h"

namespace adit::io {
namespace {

HorizontalKind transition(const LandXmlNode& node) {
  const std::string type = node.text("transitionType");
  if (type.empty()) return HorizontalKind::clothoid;
  const auto kind = landxml_transition(type);
  if (!kind)
    node.fail("the cant's transitionType " + quoted_word(type) + " is not supported",
              "have it written as clothoid (linear), Bloss, cosine or sinusoid by whoever made the design");
  return *kind;
}

/// Raises of both rails for a cant (positive: left rail higher) about a pivot.
CantStation raised(const LandXmlNode& cant, double chainage_m, double cant_m) {
  const std::string pivot = lower_case(cant.text("rotationPoint"));
  const bool left_is_outside = cant_m >= 0.0;
  if (pivot.empty() || pivot == "center") return {chainage_m, 0.5 * cant_m, -0.5 * cant_m};
  const bool about_right = pivot == "rightrail" || (pivot == "insiderail" && left_is_outside) ||
                           (pivot == "outsiderail" && !left_is_outside);
  const bool about_left = pivot == "leftrail" || pivot == "insiderail" || pivot == "outsiderail";
  if (about_right) return {chainage_m, cant_m, 0.0};
  if (about_left) return {chainage_m, 0.0, -cant_m};
  cant.fail("the cant's rotationPoint " + quoted_word(cant.text("rotationPoint")) + " is unknown",
            "write center, insideRail, outsideRail, leftRail or rightRail");
}

CantStation read_station(const LandXmlNode& cant, const LandXmlNode& node) {
  const std::string curvature = node.text("curvature");
  if (curvature != "cw" && curvature != "ccw")
    node.fail("a cant station's curvature is " + quoted_word(curvature), "write cw or ccw");
  const std::string adverse = lower_case(node.text("adverse"));
  if (!adverse.empty() && adverse != "true" && adverse != "false" && adverse != "1" && adverse != "0")
    node.fail("a cant station's adverse is " + quoted_word(adverse), "write true or false");
  const bool to_the_right = (curvature == "cw") != (adverse == "true" || adverse == "1");
  const double metres = node.number("appliedCant") * node.units().metres_per_cant_unit;
  CantStation station = raised(cant, node.length_m("station"), to_the_right ? metres : -metres);
  station.transition = transition(node);
  return station;
}

LandXmlCant read_cant(const LandXmlNode& node, const std::string& subject) {
  std::vector<CantStation> stations;
  for (const LandXmlNode& child : node.children("CantStation")) stations.push_back(read_station(node, child));
  constexpr double least_cant_m = 1e-3, widest_gauge_m = 5.0;
  double strongest_m = 0.0;
  for (const CantStation& station : stations)
    strongest_m = std::max(strongest_m, std::abs(station.left_m - station.right_m));
  if (strongest_m > 0.0 && strongest_m < least_cant_m)
    node.fail("its greatest cant would be " + short_number(1000.0 * strongest_m) + " mm: metres may be meant",
              "write appliedCant in millimetres, inches in Imperial files");
  const double gauge_m = node.length_m("gauge");
  if (gauge_m > widest_gauge_m)
    node.fail("a gauge of " + short_number(gauge_m) + " m", "write the distance from rail to rail in the file's unit");
  LandXmlCant read;
  read.cant = Cant(std::move(stations), gauge_m);
  if (node.text("rotationPoint").empty())
    read.findings.push_back({Severity::note, subject, "its cant names no rotationPoint: the axis is taken", ""});
  const std::string unread = unread_children(node, {"CantStation", "SpeedStation"});
  if (!unread.empty()) read.findings.push_back({Severity::note, subject, "not honoured in Cant: " + unread, ""});
  return read;
}

/// Level, full slope, full slope, level: the runout of the outer lane before and behind is that of the lane alone.
void add_curve(const LandXmlNode& node, const HorizontalAlignment& plan, std::vector<CantStation>& stations) {
  const auto value = [&](const char* name) {
    const auto child = node.child(name);
    if (!child)
      node.fail(std::string("a Superelevation lacks its ") + name, "export it with all stations of its curve");
    return child->numbers(1).front();
  };
  const double metres_per_unit = node.units().metres_per_unit;
  const double level_m = value("BeginRunoffSta") * metres_per_unit, full_m = value("FullSuperSta") * metres_per_unit;
  const double end_m = value("RunoffSta") * metres_per_unit, flat_m = value("StartofRunoutSta") * metres_per_unit;
  if (!(level_m <= full_m && full_m <= end_m && end_m <= flat_m))
    node.fail("the stations of a Superelevation are not in order", "correct them, or have it exported again");
  const double slope = value("FullSuperelev") / 100.0;
  const double middle_m = std::clamp(0.5 * (full_m + end_m), plan.from_m(), plan.to_m());
  const double curvature = plan.at(middle_m).curvature_per_m;
  if (curvature == 0.0 && slope != 0.0)
    node.fail("a Superelevation stands where the axis is straight: its side is not known", "correct its stations");
  const auto adverse = node.child("AdverseSE");
  const bool to_the_right = (curvature > 0.0) != (adverse && lower_case(adverse->content()) == "adverse");
  const double half_m = 0.5 * (to_the_right ? slope : -slope);
  for (const auto& [chainage_m, share] : {std::pair{level_m, 0.0}, {full_m, 1.0}, {end_m, 1.0}, {flat_m, 0.0}})
    stations.push_back({chainage_m, share * half_m, -share * half_m});
}

}  // namespace

LandXmlCant read_landxml_cant(const LandXmlNode& alignment, const HorizontalAlignment& plan,
                              const std::string& subject) {
  const std::vector<LandXmlNode> cants = alignment.children("Cant");
  const std::vector<LandXmlNode> curves = alignment.children("Superelevation");
  if (cants.empty() && curves.empty()) return {};
  const LandXmlNode& first = cants.empty() ? curves.front() : cants.front();
  if (cants.size() + (curves.empty() ? 0 : 1) > 1)
    first.fail(subject + " has several descriptions of its cant", "leave the one that is to be built");
  try {
    if (!cants.empty()) {
      LandXmlCant read = read_cant(first, subject);
      const auto& stations = read.cant.stations();
      if (!stations.empty() &&
          (stations.back().chainage_m < plan.from_m() || stations.front().chainage_m > plan.to_m()))
        first.fail("its cant stations lie beside the axis, which runs from " + short_number(plan.from_m()) + " to " +
                       short_number(plan.to_m()),
                   "give internal stations");
      return read;
    }
    std::vector<CantStation> stations;
    for (const LandXmlNode& node : curves) add_curve(node, plan, stations);
    return {Cant(std::move(stations), 1.0),
            {{Severity::note, subject, "its superelevation is taken about the axis, linear between its stations", ""}}};
  } catch (const Error& error) {
    throw Error(error.what_is_wrong(), error.where().empty() ? first.place() : error.where(), error.mend());
  }
}

}  // namespace adit::io
