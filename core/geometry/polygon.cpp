#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

AreaMoment& AreaMoment::operator+=(const AreaMoment& other) {
  area_m2 += other.area_m2;
  moment_m3 += other.moment_m3;
  moment_z_m3 += other.moment_z_m3;
  return *this;
}

AreaMoment area_moment(const Polygon& ring) {
  AreaMoment sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    const double twice = cross(a, b);
    sum.area_m2 += twice / 2.0;
    sum.moment_m3 += twice * (a.x() + b.x()) / 6.0;
    sum.moment_z_m3 += twice * (a.y() + b.y()) / 6.0;
  }
  return sum;
}

AreaMoment area_moment(const std::vector<Polygon>& rings) {
  AreaMoment sum;
  for (const Polygon& ring : rings) sum += area_moment(ring);
  return sum;
}

std::vector<Crossing> self_crossings(const Polygon& ring) {
  std::vector<Crossing> crossings;
  const std::size_t n = ring.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d& p = ring[i];
    const Eigen::Vector2d r = ring[(i + 1) % n] - p;
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours across the closing point
      const Eigen::Vector2d& q = ring[j];
      const Eigen::Vector2d s = ring[(j + 1) % n] - q;
      const double denominator = cross(r, s);
      if (std::abs(denominator) < 1e-15) continue;
      const double t = cross(q - p, s) / denominator;
      const double u = cross(q - p, r) / denominator;
      if (t >= 0.0 && t <= 1.0 && u >= 0.0 && u <= 1.0) crossings.push_back({i, j, p + t * r});
    }
  }
  return crossings;
}

}  // namespace adit
