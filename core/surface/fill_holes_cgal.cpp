#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>

#include <array>
#include <iterator>

#include "core/surface/fill_holes.h"

namespace adit {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Half = Surface::Halfedge_index;

/// The mesh in CGAL's half-edges; the triangles that fit to no others are taken out of `mesh`.
Surface surface_of(MeshArrays& mesh) {
  Surface surface;
  for (const Eigen::Vector3d& p : mesh.points) surface.add_vertex({p.x(), p.y(), p.z()});
  std::erase_if(mesh.triangles, [&](const std::array<std::uint32_t, 3>& t) {
    return surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2])) ==
           Surface::null_face();
  });
  return surface;
}

struct Loop {
  Half half;  ///< one of its halfedges
  MeshLoop points;
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
      loop.points.push_back(static_cast<std::uint32_t>(surface.source(half)));
      half = surface.next(half);
    } while (half != start);
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

FilledMesh fill_holes(const MeshArrays& mesh, const std::function<bool(const MeshLoop& loop)>& stays_open) {
  FilledMesh filled{mesh, {}, true};
  Surface surface = surface_of(filled.mesh);
  filled.joined = filled.mesh.triangles.size() == mesh.triangles.size();
  for (Loop& loop : loops_of(surface)) {
    std::vector<Surface::Face_index> faces;
    if (!stays_open(loop.points))
      CGAL::Polygon_mesh_processing::triangulate_hole(surface, loop.half, std::back_inserter(faces));
    if (faces.empty()) filled.open.push_back(std::move(loop.points));
    for (const Surface::Face_index face : faces) {
      const Half half = surface.halfedge(face);
      filled.mesh.triangles.push_back({static_cast<std::uint32_t>(surface.source(half)),
                                       static_cast<std::uint32_t>(surface.target(half)),
                                       static_cast<std::uint32_t>(surface.target(surface.next(half)))});
    }
  }
  return filled;
}

}  // namespace adit
