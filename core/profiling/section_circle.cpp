#include "core/profiling/section_circle.h"

#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/profiling/ring_fit.h"

namespace adit {

std::optional<DesignCircle> circle_of(const Profile& profile) {
  constexpr double same_m = 1e-4;
  std::optional<DesignCircle> circle;
  for (const ProfileSegment& segment : profile.segments()) {
    if (segment.bulge == 0.0) return std::nullopt;
    const Eigen::Vector2d chord = segment.end - segment.start;
    const double b = segment.bulge;
    // The centre stands beside the middle of the chord, (1 - b^2) / (4 b) chords to its left.
    const Eigen::Vector2d center =
        0.5 * (segment.start + segment.end) + (1.0 - b * b) / (4.0 * b) * Eigen::Vector2d(-chord.y(), chord.x());
    const double radius_m = (segment.start - center).norm();
    if (!circle) circle = DesignCircle{center, radius_m};
    if ((center - circle->center).norm() > same_m || std::abs(radius_m - circle->radius_m) > same_m)
      return std::nullopt;
  }
  return circle;
}

SectionCircle best_circle(const std::vector<OutlinePoint>& outline, const DesignCircle& design) {
  constexpr std::size_t every = 5, least_points = 12;  // outline points stand closer than the cells they come from
  constexpr double least_covered_deg = 90.0;
  std::vector<RingPlace> places;
  for (std::size_t i = 0; i < outline.size(); i += every)
    if (outline[i].kind == CellKind::measured)
      places.push_back({{outline[i].position.x(), 0.0, outline[i].position.y()}, 0.0});
  SectionCircle circle;
  if (places.size() < least_points) return circle;
  RingFit fit;
  try {
    fit = fit_ring(places, Eigen::Vector3d::UnitY());
  } catch (const Error&) {
    return circle;  // no circle: what was measured lies on a line
  }
  if (fit.covered_deg < least_covered_deg) return circle;
  circle.there = true;
  circle.center = {fit.center.x(), fit.center.z()};
  circle.deviation_m = circle.center - design.center;
  circle.radius_m = fit.radius_m;
  circle.design_radius_m = design.radius_m;
  circle.rms_m = fit.rms_m;
  circle.covered_deg = fit.covered_deg;
  circle.sigma_center_m = fit.sigma_center_m;
  circle.sigma_radius_m = fit.sigma_radius_m;
  circle.ovality_m = fit.ovality_m;
  if (std::isfinite(fit.ovality_m))
    circle.major_clock_deg =
        std::fmod(deg_from_rad(std::atan2(fit.major_direction.x(), fit.major_direction.z())) + 360.0, 180.0);
  return circle;
}

}  // namespace adit
