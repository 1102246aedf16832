#pragma once
// Normals from neighbours, with how well each is known.

#include <Eigen/Core>

#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/nearest_neighbours.h"

namespace adit {

/// Unit normal of the plane through the nearest points, turned towards the viewpoint; variance of its direction per
/// tangential axis [rad2], from the scatter about the plane (sigma^2 / (k * tangential variance)); planar is false
/// where the neighbours are no surface (an edge, a wire, a stray point).
struct SurfaceNormal {
  Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();
  float variance_rad2 = 0.0F;
  bool planar = false;
};

inline constexpr int normal_neighbours = 12;

std::vector<SurfaceNormal> surface_normals(const std::vector<Eigen::Vector3f>& points, const NearestNeighbours& tree,
                                           const Eigen::Vector3f& viewpoint, Progress& progress);

}  // namespace adit
