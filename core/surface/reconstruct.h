#pragma once
// Registered points to a triangle mesh.

#include <Eigen/Core>

#include <vector>

#include "core/foundation/progress.h"
#include "core/surface/mesh.h"
#include "core/surface/surface_options.h"

namespace adit {

/// Advancing front surface (Cohen-Steiner and Da 2004, through CGAL) of evenly spaced points [local frame], triangles
/// turned so that their normals face the viewpoints. A cancel is heard within some tenths of a
/// second. Throws Error with fewer than 100 points.
Mesh reconstruct(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& viewpoints,
                 const SurfaceOptions& options, Progress& progress);

}  // namespace adit
