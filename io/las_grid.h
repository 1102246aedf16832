#pragma once
// The grid of whole numbers that coordinates of LAS and LAZ files stand on.

#include <Eigen/Core>

#include "core/geometry/bounding_box.h"

namespace adit::io {

/// coordinate = offset + whole number of 32 bits * scale.
struct LasGrid {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  double scale_m = 1e-4;
};

/// A whole-metre middle, and 0.1 mm, or the finest greater power of ten that keeps every coordinate within 32 bits.
inline LasGrid las_grid(const BoundingBox& box) {
  LasGrid grid{box.center().array().round(), 1e-4};
  const double farthest = (box.max() - grid.offset).cwiseMax(grid.offset - box.min()).maxCoeff();
  while (farthest / grid.scale_m > 2.147e9) grid.scale_m *= 10.0;
  return grid;
}

}  // namespace adit::io
