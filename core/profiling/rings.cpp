#include "core/profiling/rings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "core/profiling/ring_outliers.h"

namespace adit {
namespace {

constexpr double largest_tilt_deg = 5.0;
constexpr double largest_harm_m = 0.01;

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

std::vector<RingPlace> places_of(const Ring& ring) {
  std::vector<RingPlace> places;
  for (const RingPoint* point : ring) places.push_back(point->place);
  return places;
}

TunnelPoint at_axis(const Alignment& axis, const Eigen::Vector3d& place) {
  const auto at = axis.to_tunnel(place);
  if (!at) throw Error("it has no single foot on the axis", {}, "check its coordinates, and the axis");
  return *at;
}

/// Names of points, "3, 4 and 7".
std::string names_of(const Ring& ring, const std::vector<std::size_t>& which) {
  std::string names;
  for (std::size_t i = 0; i < which.size(); ++i)
    names += (i == 0 ? "" : i + 1 == which.size() ? " and " : ", ") + ring[which[i]]->point;
  return (which.size() == 1 ? "point " : "points ") + names;
}

/// Points that do not fit to the circle of most: named, not left out.
void look_for_blunders(const Ring& ring, const RingFit& fit, const Directions& tunnel, const std::string& subject,
                       Findings& findings) {
  const std::vector<std::size_t> off = ring_outliers(places_of(ring), fit, tunnel.along);
  if (off.empty()) return;
  std::vector<RingPlace> rest;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (std::find(off.begin(), off.end(), i) == off.end()) rest.push_back(ring[i]->place);
  const RingFit others = fit_ring(rest, tunnel.along);
  double farthest = 0.0;
  for (const std::size_t i : off)
    farthest = std::max(farthest, std::abs((ring[i]->place.position - others.center).norm() +
                                           ring[i]->place.target_offset_m - others.radius_m));
  const double moved = (others.center - fit.center).norm();
  const double change = std::max(moved, std::abs(others.radius_m - fit.radius_m));
  findings.push_back({change > largest_harm_m ? Severity::decision : Severity::warning, subject,
                      names_of(ring, off) + (off.size() == 1 ? " lies " : " lie up to ") + millimetres(farthest) +
                          " off the circle of the other " + std::to_string(rest.size()) + ", which fit to " +
                          millimetres(others.rms_m) + "; without, the centre moves by " + millimetres(moved),
                      "measure again, or take out of the file what is no ring"});
}

/// What makes a circle doubtful or none at all.
void judge(const Ring& ring, const RingFit& fit, const RingResult& result, const RingDesign& design,
           const std::string& subject, Findings& findings) {
  const auto say = [&](bool decision, const std::string& words, const std::string& mend) {
    findings.push_back({decision ? Severity::decision : Severity::warning, subject, words, mend});
  };
  constexpr double largest_rms_m = 0.05, share_of_radius = 0.02, thickest_m = 0.25, smallest_radius_m = 0.2;
  constexpr double weak_center_m = 0.01, unknown_center_m = 0.02, turned_deg = 30.0, half_deg = 180.0,
                   design_share = 0.1;
  if (ring.size() == 3) say(false, "three points give a circle that nothing checks", "measure more");
  if (ring.size() > 3 && fit.covered_deg < half_deg)
    say(false, "its points cover " + short_number(std::round(fit.covered_deg)) + " degrees of it only",
        "measure points all around the ring");
  if (result.tilt_deg > largest_tilt_deg)
    say(result.tilt_deg > turned_deg,
        "its plane is tilted by " + short_number(std::round(result.tilt_deg * 10.0) / 10.0) +
            " degrees against the axis",
        result.tilt_deg > turned_deg ? "east and north may be exchanged; measure its points in one plane"
                                     : "measure its points in one plane");
  if (fit.out_of_plane_m > thickest_m)
    say(true, "its points lie " + millimetres(fit.out_of_plane_m) + " (rms) beside one plane",
        "give every ring a name of its own");
  if (fit.rms_m > std::max(largest_rms_m, share_of_radius * fit.radius_m))
    say(true, "its points make no circle: they lie " + millimetres(fit.rms_m) + " (rms) beside the best one",
        "check its points");
  if (fit.sigma_center_m > weak_center_m)
    say(fit.sigma_center_m > unknown_center_m,
        "its centre is known to " + millimetres(fit.sigma_center_m) + " only (one sigma)",
        "measure points all around the ring");
  if (fit.radius_m < smallest_radius_m)
    say(true, "a radius of " + millimetres(fit.radius_m), "write coordinates in metres");
  if (design.radius_m > 0.0 && std::abs(fit.radius_m - design.radius_m) > design_share * design.radius_m)
    say(true,
        "its radius of " + short_number(std::round(fit.radius_m * 1000.0) / 1000.0) + " m is far from the design's " +
            short_number(design.radius_m) + " m",
        "check \"radius\" and the unit of the points");
  if (std::hypot(result.horizontal_deviation_m, result.vertical_deviation_m) > fit.radius_m)
    say(true, "its centre lies farther from its place than its radius", "check \"center\", the axis and the points");
}

/// Three points leave no sigma: then a deviation beyond the tolerance is not decided.
ToleranceVerdict verdict_of(const RingResult& result, double tolerance_m) {
  if (tolerance_m <= 0.0) return ToleranceVerdict::not_shown;
  const double off_m = std::max(std::abs(result.horizontal_deviation_m), std::abs(result.vertical_deviation_m));
  if (off_m <= tolerance_m) return ToleranceVerdict::kept;
  return off_m - 2.0 * result.sigma_center_m > tolerance_m ? ToleranceVerdict::broken : ToleranceVerdict::undecided;
}

/// What must be decided of a ring leaves its place undecided.
bool has_decision(const Findings& findings, const std::string& subject) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
    return finding.severity == Severity::decision && finding.subject == subject;
  });
}

void judge_place(const RingResult& result, double tolerance_m, const std::string& subject, Findings& findings) {
  if (result.verdict != ToleranceVerdict::broken && result.verdict != ToleranceVerdict::undecided) return;
  const double off_m = std::max(std::abs(result.horizontal_deviation_m), std::abs(result.vertical_deviation_m));
  if (off_m <= tolerance_m) return;  // said already: there is something to decide
  findings.push_back({Severity::warning, subject,
                      "its centre lies " + millimetres(off_m) + " off, of " + millimetres(tolerance_m) + " permitted" +
                          (result.verdict == ToleranceVerdict::undecided
                               ? std::isfinite(result.sigma_center_m)
                                     ? ", but by less than two sigmas: the measurement does not decide it"
                                     : ", but three points leave no sigma: the measurement does not decide it"
                               : ""),
                      "look at rings.csv"});
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
  look_for_blunders(ring, fit, tunnel, subject, findings);
  judge(ring, fit, result, design, subject, findings);
  result.verdict = verdict_of(result, design.tolerance_m);
  if (result.verdict == ToleranceVerdict::kept && has_decision(findings, subject))
    result.verdict = ToleranceVerdict::undecided;
  judge_place(result, design.tolerance_m, subject, findings);
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
  result.design = design;
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
