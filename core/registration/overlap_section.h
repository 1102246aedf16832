#pragma once
// A thin section through two placed scans where they overlap: what an eye judges a pair by.

#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/geometry/tile_source.h"

namespace adit {

/// Half-way between two stations, or where both see more when they do not see enough there; upright, across the line
/// from one to the other.
struct OverlapSection {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< local frame
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();  ///< as seen from the target
  double half_thickness_m = 0.02;
  std::vector<Eigen::Vector2f> target;  ///< points, right of and above the centre [m]
  std::vector<Eigen::Vector2f> source;
};

/// Points within 2 cm of the section (up to 4 cm where scans are thin) and 20 m of its centre, of each scan an even
/// subsample of at most most_points.
OverlapSection overlap_section(const TileSource& target, const Pose& local_from_target, const TileSource& source,
                               const Pose& local_from_source, std::size_t most_points, const Progress& progress);

}  // namespace adit
