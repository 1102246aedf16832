#include "io/axis_from_points.h"

#include <cmath>
#include <utility>

#include "core/design/point_axis.h"
#include "core/foundation/angle.h"
#include "core/foundation/options.h"

namespace adit::io {
namespace {

constexpr double reported_advance_m = 1e-3;
constexpr double reported_scatter_m = 1e-3;
constexpr double reported_bend_rad = 2e-4;

std::string millimetres(double metres) {
  return short_number(std::round(metres * 1e4) / 10.0) + " mm";
}

std::string degrees(double angle_rad) {
  return short_number(std::round(deg_from_rad(angle_rad) * 1e4) / 1e4) + " degrees";
}

Findings findings_of(const PointAxis& axis, const std::string& subject) {
  Findings findings;
  const bool scattered = axis.worst_scatter_m > reported_scatter_m;
  if (axis.smooth && axis.worst_scatter_m > 0.0)
    findings.push_back({scattered ? Severity::warning : Severity::note, subject,
                        "arcs are laid through its " + std::to_string(axis.chainages_m.size()) +
                            " points; a point lies up to " + millimetres(axis.worst_scatter_m) +
                            " beside the curve through its neighbours (median " + millimetres(axis.scatter_m) + ")",
                        scattered ? "between points it is not known better: ask for its lines and curves" : ""});
  if (!axis.corners.empty())
    findings.push_back(
        {Severity::warning, subject,
         "it bends all at once at " + std::to_string(axis.corners.size()) + " of its points, first at chainage " +
             short_number(axis.chainages_m[axis.corners.front()]) + ", by up to " + degrees(axis.sharpest_bend_rad),
         "offsets jump there; ask whether the corners are meant"});
  if (!axis.smooth && axis.sharpest_bend_rad > reported_bend_rad)
    findings.push_back(
        {Severity::warning, subject,
         "its points are joined by straight pieces, which bend by up to " + degrees(axis.sharpest_bend_rad),
         "where the axis is curved, give its lines and curves, or points every 0.5 m"});
  if (axis.worst_advance_m > reported_advance_m)
    findings.push_back({Severity::warning, subject,
                        "up to point " + std::to_string(axis.worst_advance_at + 1) + " the chainage advances by " +
                            millimetres(axis.worst_advance_m) + " more or less than the points lie apart",
                        "the chainages are used; ask whether coordinates or chainage are wrong there"});
  return findings;
}

VerticalAlignment grades(const PointAxis& axis, const std::vector<double>& elevations_m) {
  std::vector<VerticalPoint> points;
  for (std::size_t i = 0; i < elevations_m.size(); ++i) {
    VerticalPoint point;
    point.chainage_m = axis.chainages_m[i];
    point.elevation_m = elevations_m[i];
    points.push_back(point);
  }
  return points.empty() ? VerticalAlignment() : VerticalAlignment(std::move(points));
}

}  // namespace

AxisOfFile axis_from_points(const std::string& name, const ListedPoints& points,
                            const std::optional<double>& start_chainage_m, const std::string& file) {
  AxisOfFile read;
  read.name = name;
  try {
    if (points.chainages_m.empty() && !start_chainage_m)
      throw Error("the file states no chainages", file, "give the chainage of the axis's first point");
    if (!points.chainages_m.empty() && start_chainage_m)
      throw Error("the file states its chainages, and a start chainage is given, too", file,
                  "leave the start chainage out");
    PointAxis axis = axis_through(points.plan, points.chainages_m, start_chainage_m.value_or(0.0));
    read.findings = findings_of(axis, "alignment " + name);
    VerticalAlignment vertical = grades(axis, points.elevations_m);
    read.axis.emplace(name, std::move(axis.horizontal), std::move(vertical));
  } catch (const Error& error) {
    read.refusal.emplace(error.what_is_wrong(), file, error.mend());
  }
  return read;
}

}  // namespace adit::io
