#pragma once
// A scan seen from above: the walls around the floor on which the scanner stood. Two such views say where one scan
// could stand in the other when nothing is known about it.

#include <Eigen/Core>

#include <vector>

#include "core/geometry/pose.h"
#include "core/registration/distribution_map.h"

namespace adit {

/// Levelled frame: z is the normal of the floor, the origin lies on the floor beneath the scanner.
struct PlanView {
  Pose scan_from_level = Pose::Identity();
  std::vector<Eigen::Vector2d> walls;  ///< one a piece of wall of about a cell's size, levelled frame [m]
  bool has_floor = false;              ///< false: no floor was found; z is the scan's own
};

/// From a scan with the scanner at its origin and z within some 20 degrees of up.
PlanView plan_view(const DistributionMap& cells);

/// A way to lay the source's plan on the target's, and how well the walls meet (most is best).
struct PlanMatch {
  Pose target_from_source = Pose::Identity();  ///< of the scans, not of the plans
  double score = 0.0;
};

/// The best ways, best first, no two of them alike (1.2 m or 8 degrees apart at least); any yaw, shifts of up to
/// reach_m. In a straight tunnel the true one is anywhere in the list: walls alone say little along it.
std::vector<PlanMatch> plan_matches(const PlanView& target, const PlanView& source, double reach_m, std::size_t most);

}  // namespace adit
