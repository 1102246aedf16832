#include "core/profiling/mesh_volume.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/foundation/angle.h"
#include "core/foundation/parallel.h"
#include "core/surface/fill_holes.h"
#include "core/surface/mesh.h"

namespace adit {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

/// The part of a convex polygon where sign * (s - at) >= 0.
Corners clipped(const Corners& polygon, double at_m, double sign) {
  Corners kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a.x() - at_m), db = sign * (b.x() - at_m);
    if (da >= 0.0) kept.push_back(a);
    if ((da >= 0.0) != (db >= 0.0)) kept.push_back(a + da / (da - db) * (b - a));
  }
  return kept;
}

/// Integral of F . n over a triangle; F is of second degree, for which the middles of the edges are enough.
double flux(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const SliceShape& shape) {
  const Eigen::Vector3d twice_area = (b - a).cross(c - a);
  double sum = 0.0;
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0.5 * (a + b)), Eigen::Vector3d(0.5 * (b + c)), Eigen::Vector3d(0.5 * (c + a))}) {
    const double x = p.y(), z = p.z();
    const double f = shape.per_area / 2.0 - shape.per_x * x / 3.0 - shape.per_z * z / 3.0;
    sum += f * (x * twice_area.y() + z * twice_area.z());
  }
  return sum / 6.0;
}

/// True for a loop of (s, x, z) that goes around a place of the section.
bool goes_around(const std::vector<Eigen::Vector3d>& loop, const Eigen::Vector2d& middle) {
  double turned_rad = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector2d a = loop[i].tail<2>() - middle, b = loop[(i + 1) % loop.size()].tail<2>() - middle;
    turned_rad += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turned_rad) > pi;
}

/// Points of a mesh in tunnel coordinates.
struct Places {
  std::vector<Eigen::Vector3d> points;  ///< (s, x, z)
  std::vector<char> known;              ///< zero beyond the axis

  bool is_end(const MeshLoop& loop, const DesignTunnel& design) const {
    std::vector<Eigen::Vector3d> ring;
    for (const std::uint32_t point : loop) {
      if (known[point] == 0) return true;
      ring.push_back(points[point]);
    }
    return goes_around(ring, design.profile_at(ring.front().x()).box().center());
  }
};

Places places_of(const MeshArrays& mesh, const DesignTunnel& design) {
  Places places{std::vector<Eigen::Vector3d>(mesh.points.size()), std::vector<char>(mesh.points.size(), 0)};
  parallel_for_each_index(mesh.points.size(), [&](std::size_t i) {
    const auto vertical = design.alignment().to_tunnel(mesh.points[i]);
    if (!vertical) return;
    const TunnelPoint at = design.in_section(*vertical);
    places.known[i] = 1;
    places.points[i] = {at.s_m, at.x_m, at.z_m};
  });
  return places;
}

/// The pieces of a mesh that have an end of the tunnel.
MeshArrays tubes(const MeshArrays& mesh, const Places& places, const DesignTunnel& design) {
  std::vector<std::uint32_t> piece(mesh.points.size());  // of each point: one that stands for its piece
  std::iota(piece.begin(), piece.end(), 0U);
  const auto root = [&](std::uint32_t point) {
    while (piece[point] != point) point = piece[point] = piece[piece[point]];
    return point;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    piece[root(a)] = root(b);
    piece[root(b)] = root(c);
  }
  std::vector<char> is_tube(mesh.points.size(), 0);
  for (const MeshLoop& loop : boundary_loops(mesh_from_arrays(mesh)))
    if (places.is_end(loop, design)) is_tube[root(loop.front())] = 1;
  MeshArrays kept{mesh.points, {}};
  for (const auto& triangle : mesh.triangles)
    if (is_tube[root(triangle[0])] != 0) kept.triangles.push_back(triangle);
  return kept;
}

}  // namespace

MeshInTunnel::MeshInTunnel(const MeshArrays& mesh, const DesignTunnel& design) {
  const Places places = places_of(mesh, design);
  const MeshArrays tunnel = tubes(mesh, places, design);
  const FilledMesh whole = fill_holes(tunnel, [&](const MeshLoop& loop) { return places.is_end(loop, design); });
  for (std::size_t t = 0; t < whole.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = whole.mesh.triangles[t];
    if (places.known[a] == 0 || places.known[b] == 0 || places.known[c] == 0) continue;
    add({places.points[a], places.points[b], places.points[c]}, design, t >= tunnel.triangles.size());
  }
  for (const MeshLoop& loop : whole.open) {
    std::vector<Eigen::Vector3d> rim;
    for (const std::uint32_t point : loop)
      if (places.known[point] != 0) rim.push_back(places.points[point]);
    const bool end = rim.size() == loop.size() && places.is_end(loop, design);
    if (end) flatten(rim, design);
    one_tube_ = one_tube_ && end;
  }
  // Two ends, one to either side: otherwise the tube is torn, and something is missing between its pieces.
  one_tube_ = one_tube_ && whole.joined && whole.open.size() == 2 && from_m_ < to_m_;
}

void MeshInTunnel::add(const std::array<Eigen::Vector3d, 3>& corners, const DesignTunnel& design, bool filled) {
  const double s_m = (corners[0].x() + corners[1].x() + corners[2].x()) / 3.0;
  const Alignment& axis = design.alignment();
  triangles_.push_back({corners, design.slice_shape(std::clamp(s_m, axis.from_m(), axis.to_m())), filled});
  middle_s_m_ += (s_m - middle_s_m_) / static_cast<double>(triangles_.size());
}

void MeshInTunnel::flatten(const std::vector<Eigen::Vector3d>& rim, const DesignTunnel& design) {
  const auto [least, greatest] = std::minmax_element(
      rim.begin(), rim.end(), [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); });
  const double least_m = least->x(), greatest_m = greatest->x();
  const bool far_end = least_m + greatest_m > 2.0 * middle_s_m_;
  const double plane_m = far_end ? greatest_m : least_m;
  (far_end ? to_m_ : from_m_) = plane_m;
  const auto on_plane = [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(plane_m, p.y(), p.z()); };
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Eigen::Vector3d &p = rim[i], &q = rim[(i + 1) % rim.size()];
    add({p, q, on_plane(q)}, design, true);
    add({p, on_plane(q), on_plane(p)}, design, true);
  }
}

MeshVolume MeshInTunnel::between(double from_m, double to_m) const {
  struct Sums {
    double flux = 0.0, filled_m2 = 0.0;
    Sums& operator+=(const Sums& other) {
      flux += other.flux;
      filled_m2 += other.filled_m2;
      return *this;
    }
  };
  const Sums sums = parallel_ordered_sum(triangles_.size(), 4096, Sums{}, [&](std::size_t begin, std::size_t end) {
    Sums part;
    for (std::size_t t = begin; t < end; ++t) {
      const Triangle& triangle = triangles_[t];
      Corners inside(triangle.corners.begin(), triangle.corners.end());
      inside = clipped(clipped(inside, from_m, 1.0), to_m, -1.0);
      for (std::size_t i = 2; i < inside.size(); ++i) {
        part.flux += flux(inside[0], inside[i - 1], inside[i], triangle.shape);
        if (triangle.filled) part.filled_m2 += 0.5 * (inside[i - 1] - inside[0]).cross(inside[i] - inside[0]).norm();
      }
    }
    return part;
  });
  const MeshVolume volume{true, std::abs(sums.flux), sums.filled_m2, one_tube_ && from_m >= from_m_ && to_m <= to_m_};
  return volume;
}

}  // namespace adit
