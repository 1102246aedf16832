#pragma once
// Pulses without an echo that a scanner wrote as points at its largest range.

#include <cstddef>

#include "core/geometry/point_cloud.h"

namespace adit {

/// Removes the points that share the scan's largest distance from the scanner (the frame's origin) within 1 cm, when
/// they are more than 0.3 % of all and that distance exceeds 10 m: no surface of a tunnel is a sphere about the
/// scanner. Returns how many went.
std::size_t remove_no_returns(PointCloud& cloud);

}  // namespace adit
