#pragma once
// The best circle of a section, for tunnels that are designed round.

#include <optional>
#include <vector>

#include "core/design/profile.h"
#include "core/profiling/section.h"

namespace adit {

/// The circle that a profile is, if it is one: all its segments are arcs about one centre.
struct DesignCircle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};
std::optional<DesignCircle> circle_of(const Profile& profile);

/// Least squares through the measured points of an outline, in the section plane (core/profiling/ring_fit.h). Not there
/// where fewer than twelve cells or 90 degrees were measured. Its
/// sigmas are those of the fit alone.
SectionCircle best_circle(const std::vector<OutlinePoint>& outline, const DesignCircle& design);

}  // namespace adit
