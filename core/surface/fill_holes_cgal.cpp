#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <cmath>
#include <iterator>

#include "core/surface/fill_holes.h"

namespace adit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Half = Surface::Halfedge_index;

Surface surface_of(const MeshArrays& mesh) {
  Surface surface;
  for (const Eigen::Vector3d& p : mesh.points) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& t : mesh.triangles)
    surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
  return surface;
}

struct Loop {
  Half half;  ///< one of its halfedges
  std::vector<std::uint32_t> points;
};

std::vector<Loop> loops_of(const Surface& surface) {
  std::vector<char> seen(surface.number_of_halfedges(), 0);
  std::vector<Loop> loops;
  for (const Half start : surface.halfedges()) {
    if (!surface.is_border(start) || seen[start] != 0) continue;
    Loop loop{start, {}};
    Half half = start;
    do {
      seen[half] = 1;
      loop.points.push_back(static_cast<std::uint32_t>(surface.target(half)));
      half = surface.next(half);
    } while (half != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

double area_m2(const Surface& surface, Surface::Face_index face) {
  const Half half = surface.halfedge(face);
  const auto& a = surface.point(surface.source(half));
  const auto& b = surface.point(surface.target(half));
  const auto& c = surface.point(surface.target(surface.next(half)));
  return std::sqrt(CGAL::squared_area(a, b, c));
}

}  // namespace

std::vector<std::vector<std::uint32_t>> boundary_loops(const MeshArrays& mesh) {
  std::vector<std::vector<std::uint32_t>> loops;
  for (Loop& loop : loops_of(surface_of(mesh))) loops.push_back(std::move(loop.points));
  return loops;
}

FilledMesh fill_holes(const MeshArrays& mesh,
                      const std::function<bool(const std::vector<std::uint32_t>& loop)>& stays_open) {
  Surface surface = surface_of(mesh);
  FilledMesh filled{mesh, 0, 0.0};
  for (const Loop& loop : loops_of(surface)) {
    if (stays_open(loop.points)) continue;
    std::vector<Surface::Face_index> faces;
    CGAL::Polygon_mesh_processing::triangulate_hole(surface, loop.half, std::back_inserter(faces));
    if (faces.empty()) continue;
    ++filled.holes;
    for (const Surface::Face_index face : faces) {
      filled.filled_m2 += area_m2(surface, face);
      const Half half = surface.halfedge(face);
      filled.mesh.triangles.push_back({static_cast<std::uint32_t>(surface.source(half)),
                                       static_cast<std::uint32_t>(surface.target(half)),
                                       static_cast<std::uint32_t>(surface.target(surface.next(half)))});
    }
  }
  return filled;
}

}  // namespace adit
