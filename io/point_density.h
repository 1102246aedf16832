#pragma once
// How dense the points of a scan lie, from some of them.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/geometry/bounding_box.h"
#include "io/scan_formats.h"

namespace adit::io {

/// From points spread evenly over a scan [m], each of which stands for `stands_for` of its points. The density at a
/// point comes from the distance of its eighth neighbour. Given is the median at 5 m from the origin (from the points
/// between 4 and 6 m), where the points lie around the origin as those of a scanner do; else the median of all.
/// Empty for fewer than 100 points. box: of the whole scan, which tells whether its points lie around the origin.
std::optional<PointDensity> point_density(const std::vector<Eigen::Vector3d>& points, double stands_for,
                                          const BoundingBox& box);

}  // namespace adit::io
