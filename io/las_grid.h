#pragma once
// The grid of whole numbers that coordinates of LAS and LAZ files stand on.

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>

#include "core/geometry/bounding_box.h"

namespace adit::io {

/// coordinate = offset + whole number of 32 bits * scale.
struct LasGrid {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double scale_m = 1e-4;

  /// The whole numbers of a position.
  std::array<std::int32_t, 3> steps(const Eigen::Vector3d& position) const {
    std::array<std::int32_t, 3> numbers{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<Eigen::Index>(axis);
      numbers[axis] = static_cast<std::int32_t>(std::lround((position[k] - offset[k]) / scale_m));
    }
    return numbers;
  }
  /// The position as a reader finds it.
  Eigen::Vector3d rounded(const Eigen::Vector3d& position) const {
    const auto numbers = steps(position);
    return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]) * scale_m + offset;
  }
};

/// A whole-metre middle, and 0.1 mm, or the finest greater power of ten that keeps every coordinate within 32 bits.
inline LasGrid las_grid(const BoundingBox& box) {
  LasGrid grid{box.center().array().round(), 1e-4};
  const double farthest = (box.max() - grid.offset).cwiseMax(grid.offset - box.min()).maxCoeff();
  while (farthest / grid.scale_m > 2.147e9) grid.scale_m *= 10.0;
  return grid;
}

}  // namespace adit::io
