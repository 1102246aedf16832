#include "core/surface/mesh.h"

#include <algorithm>
#include <functional>

namespace adit {
namespace {

/// Lengths of all boundary loops, longest first.
std::vector<double> boundary_loops_m(const Mesh& mesh) {
  const auto point = [&](std::uint32_t index) { return mesh.point(Mesh::VertexHandle(static_cast<int>(index))); };
  std::vector<double> lengths;
  for (const auto& loop : boundary_loops(mesh)) {
    double length = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      length += (point(loop[(i + 1) % loop.size()]) - point(loop[i])).norm();
    lengths.push_back(length);
  }
  std::sort(lengths.begin(), lengths.end(), std::greater<>());
  return lengths;
}

std::size_t components_of(const Mesh& mesh) {
  std::vector<char> seen(mesh.n_vertices(), 0);
  std::size_t components = 0;
  for (const auto start : mesh.vertices()) {
    if (seen[static_cast<std::size_t>(start.idx())] != 0) continue;
    ++components;
    std::vector<Mesh::VertexHandle> open{start};
    seen[static_cast<std::size_t>(start.idx())] = 1;
    while (!open.empty()) {
      const auto vertex = open.back();
      open.pop_back();
      for (const auto next : mesh.vv_range(vertex)) {
        if (seen[static_cast<std::size_t>(next.idx())] != 0) continue;
        seen[static_cast<std::size_t>(next.idx())] = 1;
        open.push_back(next);
      }
    }
  }
  return components;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> boundary_loops(const Mesh& mesh) {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<char> seen(mesh.n_halfedges(), 0);
  for (const auto start : mesh.halfedges()) {
    if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())] != 0) continue;
    loops.emplace_back();
    auto half = start;
    do {
      seen[static_cast<std::size_t>(half.idx())] = 1;
      loops.back().push_back(static_cast<std::uint32_t>(half.from().idx()));
      half = half.next();
    } while (half != start && seen[static_cast<std::size_t>(half.idx())] == 0);
  }
  return loops;
}

MeshArrays mesh_arrays(const Mesh& mesh) {
  MeshArrays arrays;
  arrays.points.reserve(mesh.n_vertices());
  for (const auto vertex : mesh.vertices()) arrays.points.push_back(mesh.point(vertex));
  arrays.triangles.reserve(mesh.n_faces());
  for (const auto face : mesh.faces()) {
    std::array<std::uint32_t, 3> triangle{};
    std::size_t i = 0;
    for (const auto vertex : mesh.fv_range(face)) triangle[i++] = static_cast<std::uint32_t>(vertex.idx());
    arrays.triangles.push_back(triangle);
  }
  return arrays;
}

Mesh mesh_from_arrays(const MeshArrays& arrays) {
  Mesh mesh;
  mesh.reserve(arrays.points.size(), arrays.triangles.size() * 3 / 2, arrays.triangles.size());
  std::vector<Mesh::VertexHandle> vertices;
  vertices.reserve(arrays.points.size());
  for (const auto& point : arrays.points) vertices.push_back(mesh.add_vertex(point));
  for (const auto& triangle : arrays.triangles)
    mesh.add_face(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]);
  return mesh;
}

MeshSummary summarise(const Mesh& mesh) {
  MeshSummary summary;
  summary.points = mesh.n_vertices();
  summary.triangles = mesh.n_faces();
  summary.edges = mesh.n_edges();
  summary.components = components_of(mesh);
  for (const auto face : mesh.faces()) {
    const auto half = mesh.halfedge_handle(face);
    summary.area_m2 += mesh.calc_sector_area(half);
  }
  for (const auto edge : mesh.edges()) summary.mean_edge_m += mesh.calc_edge_length(edge);
  if (summary.edges > 0) summary.mean_edge_m /= static_cast<double>(summary.edges);
  const std::vector<double> loops = boundary_loops_m(mesh);
  summary.boundary_loops = loops.size();
  if (!loops.empty()) summary.longest_loop_m = loops.front();
  for (std::size_t i = 2; i < loops.size(); ++i) summary.holes_m += loops[i];
  return summary;
}

}  // namespace adit
