#pragma once
// Coordinates too large for float32 are stored less a whole-metre offset.

#include <Eigen/Core>

#include <span>
#include <string>

#include "core/geometry/bounding_box.h"

namespace adit::io {

/// The offset for a scan that begins with these points (a block of them, file coordinates [m]): zero where float32
/// holds them to 0.05 mm and they lie within 10 km of zero, else their middle in whole metres. The first block
/// decides, so that a stream need not be read twice. Error with `where` for coordinates beyond 10^10 m.
Eigen::Vector3d offset_for(std::span<const Eigen::Vector3d> first_points, const std::string& where);

/// Error with `where` when points within the box (file coordinates) lie so far from the offset that float32 would
/// round by more than 2 mm.
void expect_near_offset(const BoundingBox& box, const Eigen::Vector3d& offset, const std::string& where);

}  // namespace adit::io
