#pragma once
// Areas, first moments and boolean differences of outlines in the section plane (x, z) [m].

#include <Eigen/Core>

#include <vector>

namespace adit {

/// A closed ring of points (x, z) [m]; the last point is not the first again.
using Polygon = std::vector<Eigen::Vector2d>;

/// Signed area [m2] (positive counter-clockwise) and first moments about x = 0 and z = 0 [m3]: the integrals of 1, x
/// and z over the inside (Green's theorem).
struct AreaMoment {
  double area_m2 = 0.0;
  double moment_m3 = 0.0;    ///< of x
  double moment_z_m3 = 0.0;  ///< of z
  AreaMoment& operator+=(const AreaMoment& other);
};

/// Of one ring; signs follow its sense of rotation.
AreaMoment area_moment(const Polygon& ring);

/// Of a set of rings as the boolean functions return them: outer rings positive, holes negative.
AreaMoment area_moment(const std::vector<Polygon>& rings);

/// a without b, under the non-zero rule, coordinates rounded to 1 micrometre (robust against every degeneracy).
std::vector<Polygon> difference(const Polygon& a, const Polygon& b);

/// Parallel curve of a ring at a distance [m], outwards positive, round joins within 0.02 mm.
std::vector<Polygon> offset_ring(const Polygon& ring, double distance_m);

/// Places where a ring crosses or touches itself; empty for a simple ring.
struct Crossing {
  std::size_t edge_a = 0;
  std::size_t edge_b = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
};
std::vector<Crossing> self_crossings(const Polygon& ring);

}  // namespace adit
