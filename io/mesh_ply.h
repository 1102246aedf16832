#pragma once
// The surface as PLY: points in site coordinates (double), deviation as a scalar, triangles.

#include <Eigen/Core>

#include <filesystem>
#include <vector>

#include "core/surface/mesh.h"

namespace adit::io {

/// A mesh in the local frame and the deviation of its points [m] (NaN where unknown; empty without a design).
struct MeshFile {
  MeshArrays mesh;
  std::vector<float> deviation_m;
};

/// Binary little endian, written atomically; origin is added to every point. Other programs read x y z, "deviation" and
/// the faces.
void write_mesh_ply(const std::filesystem::path& file, const MeshFile& mesh, const Eigen::Vector3d& origin);

/// Reads what write_mesh_ply wrote; Error for anything else.
MeshFile read_mesh_ply(const std::filesystem::path& file, const Eigen::Vector3d& origin);

}  // namespace adit::io
