#include "core/profiling/ring_outliers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/foundation/random.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

using Flat = std::vector<Eigen::Vector2d>;

struct FlatCircle {
  Eigen::Vector2d center;
  double radius_m;
};

std::optional<FlatCircle> circle_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a, ac = c - a;
  const double cross = 2.0 * (ab.x() * ac.y() - ab.y() * ac.x());
  if (std::abs(cross) < 1e-9) return std::nullopt;
  const Eigen::Vector2d to_center((ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm()) / cross,
                                  (ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) / cross);
  return FlatCircle{a + to_center, to_center.norm()};
}

std::vector<double> distances_from(const FlatCircle& circle, const Flat& points) {
  std::vector<double> distances;
  for (const Eigen::Vector2d& point : points)
    distances.push_back(std::abs((point - circle.center).norm() - circle.radius_m));
  return distances;
}

/// Calls visit(i, j, k): all triples of few points, some of many.
template <typename Visit>
void for_triples(std::size_t n, const Visit& visit) {
  constexpr std::size_t most_points = 20, draws = 1000;
  if (n <= most_points) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k) visit(i, j, k);
    return;
  }
  const Random random(1, n);
  const auto drawn = [&](std::uint64_t index) {
    return std::min(n - 1, static_cast<std::size_t>(random.uniform(index) * static_cast<double>(n)));
  };
  for (std::uint64_t t = 0; t < draws; ++t) visit(drawn(3 * t), drawn(3 * t + 1), drawn(3 * t + 2));
}

/// Of five points the one that lies off a circle through three of the others on which the fourth lies too. None where
/// several could be the one.
std::vector<std::size_t> odd_one_of_five(const Flat& points, double off_m) {
  std::vector<std::size_t> odd;
  for (std::size_t left_out = 0; left_out < points.size(); ++left_out) {
    Flat others;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (i != left_out) others.push_back(points[i]);
    const auto circle = circle_through(others[0], others[1], others[2]);
    if (!circle) continue;
    Flat rest{others[3], points[left_out]};
    const std::vector<double> distances = distances_from(*circle, rest);
    if (distances[0] <= off_m && distances[1] > off_m) odd.push_back(left_out);
  }
  return odd.size() == 1 ? odd : std::vector<std::size_t>{};
}

}  // namespace

std::vector<std::size_t> ring_outliers(const std::vector<RingPlace>& places, const RingFit& fit,
                                       const Eigen::Vector3d& along) {
  constexpr double least_m = 0.03, share_of_radius = 0.02, sigmas = 3.0;  // linings are no circles to that
  if (places.size() < 5) return {};
  // Square to the axis: the ring's own plane may be that of its wrong points.
  const Eigen::Quaterniond flat_from_site = Eigen::Quaterniond::FromTwoVectors(along, Eigen::Vector3d::UnitZ());
  Flat flat;
  for (const RingPlace& place : places) {
    const Eigen::Vector2d point = (flat_from_site * (place.position - fit.center)).head<2>();
    flat.push_back(point + place.target_offset_m * point.normalized());  // to the surface, as good as it is known
  }
  if (flat.size() == 5) return odd_one_of_five(flat, std::max(least_m, share_of_radius * fit.radius_m));
  double least_median = std::numeric_limits<double>::infinity();
  FlatCircle best{};
  for_triples(flat.size(), [&](std::size_t i, std::size_t j, std::size_t k) {
    const auto circle = circle_through(flat[i], flat[j], flat[k]);
    if (!circle) return;
    const double middle = median(distances_from(*circle, flat));
    if (middle < least_median) best = *circle;
    least_median = std::min(least_median, middle);
  });
  if (!std::isfinite(least_median)) return {};
  const double sigma = 1.4826 * (1.0 + 5.0 / static_cast<double>(flat.size() - 3)) * least_median;
  std::vector<std::size_t> off;
  const std::vector<double> distances = distances_from(best, flat);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (distances[i] > std::max({least_m, share_of_radius * best.radius_m, sigmas * sigma})) off.push_back(i);
  return off.size() + 3 > places.size() ? std::vector<std::size_t>{} : off;
}

}  // namespace adit
