#pragma once
// The half-edge mesh of the tunnel surface.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// Must follow the mesh.
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include <array>
#include <cstdint>
#include <vector>

#include "core/surface/mesh_summary.h"

namespace adit {

struct MeshTraits : public OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};

/// Triangles between points in the local frame (site minus project origin), double precision.
using Mesh = OpenMesh::TriMesh_ArrayKernelT<MeshTraits>;

/// Plain arrays of a mesh: points and triangles of point indices.
struct MeshArrays {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
MeshArrays mesh_arrays(const Mesh& mesh);
Mesh mesh_from_arrays(const MeshArrays& arrays);

/// Points of every open end and hole, in the order in which triangles that close it would run along its rim.
std::vector<std::vector<std::uint32_t>> boundary_loops(const Mesh& mesh);

/// Counts, lengths and area; the deviations are left NaN.
MeshSummary summarise(const Mesh& mesh);

}  // namespace adit
