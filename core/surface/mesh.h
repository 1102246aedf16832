#pragma once
// The half-edge mesh of the tunnel surface.

#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/point_cloud.h"

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

/// What a mesh is, in numbers.
struct MeshSummary {
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t edges = 0;
  std::size_t boundary_loops = 0;   ///< the two open ends of a tunnel and every hole
  std::size_t components = 0;
  double area_m2 = 0.0;
  double mean_edge_m = 0.0;
  double longest_loop_m = 0.0;
  double holes_m = 0.0;             ///< length of all boundary loops but the two longest
  double mean_deviation_m = 0.0;    ///< of the points from the design line, area weighted; NaN when not computed
};
MeshSummary summarise(const Mesh& mesh);

}  // namespace adit
