#include "core/profiling/rings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit {
namespace {

constexpr double largest_tilt_deg = 5.0;
constexpr double least_blunder_m = 0.01;

using Ring = std::vector<const RingPoint*>;

std::string millimetres(double metres) {
  return short_number(std::round(metres * 1e4) / 10.0) + " mm";
}

/// The tunnel's directions at a chainage.
struct Directions {
  Eigen::Vector3d along, right, up;
  double clock_deg(const Eigen::Vector3d& way) const { return deg_from_rad(std::atan2(way.dot(right), way.dot(up))); }
};

Directions directions_at(const Alignment& axis, double chainage_m) {
  const PlanPoint plan = axis.horizontal().at(chainage_m);
  const double grade = axis.vertical().at(chainage_m).grade;
  const Eigen::Vector3d along = Eigen::Vector3d(plan.tangent().x(), plan.tangent().y(), grade).normalized();
  const Eigen::Vector3d right(plan.right().x(), plan.right().y(), 0.0);
  return {along, right, right.cross(along)};
}

std::vector<RingPlace> places_of(const Ring& ring, const RingPoint* left_out = nullptr) {
  std::vector<RingPlace> places;
  for (const RingPoint* point : ring)
    if (point != left_out) places.push_back(point->place);
  return places;
}

TunnelPoint at_axis(const Alignment& axis, const Eigen::Vector3d& place) {
  const auto at = axis.to_tunnel(place);
  if (!at) throw Error("it has no single foot on the axis", {}, "check its coordinates, and the axis");
  return *at;
}

/// A point without which the others fit far better: named, not left out.
void look_for_blunder(const Ring& ring, const RingFit& fit, const Directions& tunnel, const std::string& subject,
                      Findings& findings) {
  if (ring.size() < 6) return;
  const auto worst = std::max_element(fit.residuals_m.begin(), fit.residuals_m.end(),
                                      [](double a, double b) { return std::abs(a) < std::abs(b); });
  const RingPoint* point = ring[static_cast<std::size_t>(worst - fit.residuals_m.begin())];
  const RingFit others = fit_ring(places_of(ring, point), tunnel.along);
  const double off = (point->place.position - others.center).norm() + point->place.target_offset_m - others.radius_m;
  if (std::abs(off) < least_blunder_m || std::abs(off) < 3.0 * 3.0 * others.rms_m) return;
  findings.push_back({Severity::warning, subject,
                      "point " + point->point + " lies " + millimetres(off) +
                          " off the circle of the others, which fit to " + millimetres(others.rms_m),
                      "measure it again, or take it out of the file"});
}

RingResult result_of(const std::string& name, const Ring& ring, const Alignment& axis, const RingDesign& design,
                     Findings& findings) {
  const std::string subject = "ring " + name;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const RingPoint* point : ring) middle += point->place.position / static_cast<double>(ring.size());
  const Directions tunnel = directions_at(axis, at_axis(axis, middle).s_m);
  const RingFit fit = fit_ring(places_of(ring), tunnel.along);
  const TunnelPoint center = at_axis(axis, fit.center);
  RingResult result;
  result.ring = name;
  result.center = fit.center;
  result.chainage_m = center.s_m;
  result.station_m = axis.stations().displayed_m(center.s_m);
  result.horizontal_deviation_m = center.x_m - design.center_offset_m;
  result.vertical_deviation_m = center.z_m - design.center_height_m;
  result.radius_m = fit.radius_m;
  result.ovality_m = fit.ovality_m;
  result.major_clock_deg =
      std::isfinite(fit.ovality_m) ? std::fmod(tunnel.clock_deg(fit.major_direction) + 180.0, 180.0) : fit.ovality_m;
  result.rms_m = fit.rms_m;
  result.sigma_center_m = fit.sigma_center_m;
  result.sigma_radius_m = fit.sigma_radius_m;
  result.tilt_deg = deg_from_rad(std::acos(std::min(1.0, std::abs(fit.normal.dot(tunnel.along)))));
  for (std::size_t i = 0; i < ring.size(); ++i)
    result.residuals.push_back(
        {ring[i]->point, tunnel.clock_deg(ring[i]->place.position - fit.center), fit.residuals_m[i]});
  if (ring.size() == 3)
    findings.push_back({Severity::warning, subject, "three points give a circle that nothing checks", "measure more"});
  if (result.tilt_deg > largest_tilt_deg)
    findings.push_back({Severity::warning, subject,
                        "its plane is tilted by " + short_number(std::round(result.tilt_deg * 10.0) / 10.0) +
                            " degrees against the axis",
                        "measure its points in one plane"});
  look_for_blunder(ring, fit, tunnel, subject, findings);
  return result;
}

}  // namespace

RingsResult fit_rings(const std::vector<RingPoint>& points, const Alignment& axis, const RingDesign& design,
                      Progress& progress) {
  std::vector<std::pair<std::string, Ring>> rings;  // in order of appearance
  std::map<std::string, std::size_t> number_of;
  for (const RingPoint& point : points) {
    const auto [found, is_new] = number_of.emplace(point.ring, rings.size());
    if (is_new) rings.emplace_back(point.ring, Ring{});
    rings[found->second].second.push_back(&point);
  }
  RingsResult result;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    progress.step(i, rings.size());
    const auto& [name, ring] = rings[i];
    try {
      result.rings.push_back(result_of(name, ring, axis, design, result.findings));
    } catch (const Error& error) {
      result.findings.push_back({Severity::decision, "ring " + name, error.what_is_wrong(), error.mend()});
    }
  }
  std::stable_sort(result.rings.begin(), result.rings.end(),
                   [](const RingResult& a, const RingResult& b) { return a.chainage_m < b.chainage_m; });
  return result;
}

}  // namespace adit
