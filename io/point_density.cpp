#include "io/point_density.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/geometry/nearest_neighbours.h"
#include "core/geometry/statistics.h"

namespace adit::io {
namespace {

constexpr std::size_t least_points = 100;
constexpr std::size_t least_near_points = 50;
constexpr std::size_t most_asked = 2000;
constexpr int neighbours = 8;
constexpr double distance_m = 5.0;
constexpr double band_m = 1.0;
constexpr double beyond_any_site_m = 1e10;

struct LocalDensity {
  double range_m;  ///< from the origin
  double points_per_m2;
};

/// For points strewn at random, (k - 1) / area of the circle that reaches the k-th neighbour is right on average.
std::vector<LocalDensity> local_densities(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& middle,
                                          double stands_for) {
  std::vector<Eigen::Vector3f> near_zero;
  for (const Eigen::Vector3d& p : points) near_zero.emplace_back((p - middle).cast<float>());
  const NearestNeighbours tree(near_zero);
  std::vector<LocalDensity> densities;
  const std::size_t step = std::max<std::size_t>(1, points.size() / most_asked);
  for (std::size_t i = 0; i < points.size(); i += step) {
    const auto found = tree.k_nearest(near_zero[i], neighbours + 1);  // itself among them
    const double area_m2 = pi * static_cast<double>(found.back().squared_distance_m2);
    if (area_m2 > 0.0) densities.push_back({points[i].norm(), (neighbours - 1) / area_m2 * stands_for});
  }
  return densities;
}

}  // namespace

double PointDensity::spacing_m() const {
  return 1.0 / std::sqrt(points_per_m2);
}

std::optional<PointDensity> point_density(const std::vector<Eigen::Vector3d>& points, double stands_for,
                                          const BoundingBox& box) {
  if (points.size() < least_points) return std::nullopt;
  BoundingBox own_box;
  for (const Eigen::Vector3d& p : points) own_box.extend(p);
  if (own_box.sizes().maxCoeff() > beyond_any_site_m) return std::nullopt;  // float32 would not hold them either
  std::vector<double> all, near;
  for (const LocalDensity& local : local_densities(points, own_box.center(), stands_for)) {
    all.push_back(local.points_per_m2);
    if (std::abs(local.range_m - distance_m) > band_m) continue;
    near.push_back(local.points_per_m2 * std::pow(local.range_m / distance_m, 2));
  }
  if (all.size() < least_points / 2) return std::nullopt;
  if (box.contains(Eigen::Vector3d::Zero()) && near.size() >= least_near_points)
    return PointDensity{median(near), distance_m};
  return PointDensity{median(all), std::nullopt};
}

}  // namespace adit::io
