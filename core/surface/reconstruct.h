#pragma once
// Registered points to a triangle mesh.

#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/point_cloud.h"
#include "core/surface/mesh.h"

namespace adit {

struct SurfaceOptions {
  double spacing_m = 0.15;        ///< even spacing of the points that become mesh points
  double longest_edge_m = 0.9;    ///< no triangle has a longer edge; wider gaps stay open
};

template <typename Visitor>
void describe(Visitor& v, SurfaceOptions& o) {
  v.number("spacing_m", o.spacing_m, "m", 0.02, 1.0, "even spacing of the points that become mesh points");
  v.number("longest_edge_m", o.longest_edge_m, "m", 0.05, 5.0, "no triangle has a longer edge; wider gaps stay open");
}

/// Advancing front surface (Cohen-Steiner and Da 2004, through CGAL) of evenly spaced points [local frame], triangles
/// turned so that their normals face the viewpoints. Cancel is checked between phases; the longest phase takes about
/// 4 s per 200,000 points. Throws Error with fewer than 100 points.
Mesh reconstruct(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& viewpoints,
                 const SurfaceOptions& options, Progress& progress);

}  // namespace adit
