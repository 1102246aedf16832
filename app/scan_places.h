#pragma once
// Where scans stand against the axis: what tells wrong coordinates from a wrong design.

#include "app/job_state.h"

namespace adit::app {

/// Beyond this no scan of a tunnel stands beside its axis, not even before the portal.
inline constexpr double farthest_scan_from_axis_m = 100.0;

/// Plan distance from a place (site east, north) to the nearest of many places on the axis, [m].
double distance_to_axis_m(const Alignment& axis, const Eigen::Vector2d& place);

/// A decision for every placed scan that stands too far from the axis; empty without an axis.
Findings scans_beside_axis(const JobState& state);

/// "scan S1 stands at chainage 123.4, 30.0 m right of the axis, scan S2 ...": the first few placed scans.
std::string places_in_words(const JobState& state);

}  // namespace adit::app
