#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/foundation/error.h"
#include "core/surface/ordered_triangulation_cgal.h"
#include "core/surface/reconstruct.h"

namespace adit {
namespace {

using Facet = std::array<std::size_t, 3>;

/// The front never takes a triangle with an edge longer than this. Asked for every candidate, so that a cancel is
/// heard.
struct EdgeLimit {
  double longest_m;
  const Progress* progress;

  template <typename AdvancingFront, typename Cell>
  double operator()(const AdvancingFront& front, Cell& cell, const int& index) const {
    progress->check();
    for (int i = 1; i <= 3; ++i) {
      const auto& a = cell->vertex((index + i) % 4)->point();
      const auto& b = cell->vertex((index + i % 3 + 1) % 4)->point();
      if (CGAL::squared_distance(a, b) > longest_m * longest_m) return std::numeric_limits<double>::infinity();
    }
    return front.smallest_radius_delaunay_sphere(cell, index);
  }
};

/// Inserted along a space-filling curve; every vertex knows the number of its point.
Delaunay delaunay(const std::vector<Kernel::Point_3>& points, const Progress& progress) {
  using Numbered = std::pair<Kernel::Point_3, std::size_t>;
  std::vector<Numbered> order;
  order.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) order.emplace_back(points[i], i);
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, CGAL::First_of_pair_property_map<Numbered>>());
  Delaunay triangulation;
  Delaunay::Vertex_handle last;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i % 1000 == 0) progress.check();
    last = triangulation.insert(order[i].first,
                                last == Delaunay::Vertex_handle() ? Delaunay::Cell_handle() : last->cell());
    last->info() = order[i].second;
  }
  return triangulation;
}

std::vector<Facet> advancing_front(const std::vector<Kernel::Point_3>& points, double longest_edge_m,
                                   const Progress& progress) {
  Delaunay triangulation = delaunay(points, progress);
  progress.step(3, 10);
  CGAL::Advancing_front_surface_reconstruction<Delaunay, EdgeLimit> front(triangulation,
                                                                          EdgeLimit{longest_edge_m, &progress});
  front.run(5.0, 0.52);  // CGAL's own standard values
  std::vector<Facet> facets;
  CGAL::write_triple_indices(std::back_inserter(facets), front);
  return facets;
}

/// CGAL hands facets over in an order that follows addresses in memory; this one follows the points alone.
void put_in_order(std::vector<Facet>& facets) {
  for (Facet& facet : facets) std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
  std::sort(facets.begin(), facets.end());
}

/// The parts of a soup that hang together by edges.
std::vector<std::size_t> components_of(const std::vector<Facet>& facets, std::size_t points) {
  std::vector<std::size_t> parent(points);
  for (std::size_t i = 0; i < points; ++i) parent[i] = i;
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const Facet& facet : facets)
    for (int i = 1; i < 3; ++i) parent[root(facet[static_cast<std::size_t>(i)])] = root(facet[0]);
  std::vector<std::size_t> component(facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) component[f] = root(facets[f][0]);
  return component;
}

const Eigen::Vector3d& nearest_viewpoint(const std::vector<Eigen::Vector3d>& viewpoints, const Eigen::Vector3d& point) {
  return *std::min_element(viewpoints.begin(), viewpoints.end(), [&](const auto& a, const auto& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  });
}

/// Turns whole components over whose triangles mostly look away from the scanners.
void face_viewpoints(std::vector<Facet>& facets, const std::vector<Eigen::Vector3d>& points,
                     const std::vector<Eigen::Vector3d>& viewpoints) {
  if (viewpoints.empty()) return;
  const auto component = components_of(facets, points.size());
  std::vector<double> vote(points.size(), 0.0);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Eigen::Vector3d& a = points[facets[f][0]];
    const Eigen::Vector3d normal = (points[facets[f][1]] - a).cross(points[facets[f][2]] - a);
    vote[component[f]] += normal.dot((nearest_viewpoint(viewpoints, a) - a).normalized());
  }
  for (std::size_t f = 0; f < facets.size(); ++f)
    if (vote[component[f]] < 0.0) std::swap(facets[f][1], facets[f][2]);
}

}  // namespace

Mesh reconstruct(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& viewpoints,
                 const SurfaceOptions& options, Progress& progress) {
  if (points.size() < 100)
    throw Error("a surface needs at least 100 points, there are " + std::to_string(points.size()), "",
                "use a smaller surface.spacing_m");
  std::vector<Kernel::Point_3> input;
  input.reserve(points.size());
  for (const auto& p : points) input.emplace_back(p.x(), p.y(), p.z());
  progress.step(1, 10);
  std::vector<Facet> facets = advancing_front(input, options.longest_edge_m, progress);
  put_in_order(facets);
  progress.step(7, 10);
  // Points where two sheets touch are doubled, so that every edge and corner is that of a manifold.
  CGAL::Polygon_mesh_processing::orient_polygon_soup(input, facets);
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(input.size());
  for (const auto& p : input) corners.emplace_back(p.x(), p.y(), p.z());
  face_viewpoints(facets, corners, viewpoints);
  put_in_order(facets);
  progress.step(9, 10);
  std::vector<std::uint32_t> number(corners.size(), std::numeric_limits<std::uint32_t>::max());
  MeshArrays arrays;  // only points that a triangle uses
  for (const Facet& facet : facets) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      auto& n = number[facet[i]];
      if (n == std::numeric_limits<std::uint32_t>::max()) {
        n = static_cast<std::uint32_t>(arrays.points.size());
        arrays.points.push_back(corners[facet[i]]);
      }
      triangle[i] = n;
    }
    arrays.triangles.push_back(triangle);
  }
  progress.check();
  return mesh_from_arrays(arrays);
}

}  // namespace adit
