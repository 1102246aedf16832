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

/// Of five points the one without which the other four fit to a circle far better than without any other one.
std::vector<std::size_t> odd_one_of_five(const std::vector<RingPlace>& places, const Eigen::Vector3d& along,
                                         double least_m) {
  constexpr double far_better = 3.0;
  const auto without = [&](std::size_t left_out) {
    std::vector<RingPlace> others = places;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    return fit_ring(others, along);
  };
  std::vector<double> rms_m;
  for (std::size_t i = 0; i < places.size(); ++i) rms_m.push_back(without(i).rms_m);
  const auto odd = static_cast<std::size_t>(std::min_element(rms_m.begin(), rms_m.end()) - rms_m.begin());
  for (std::size_t i = 0; i < rms_m.size(); ++i)
    if (i != odd && rms_m[i] < far_better * rms_m[odd]) return {};
  const RingFit rest = without(odd);
  const double off_m =
      std::abs((places[odd].position - rest.center).norm() + places[odd].target_offset_m - rest.radius_m);
  return off_m > least_m ? std::vector{odd} : std::vector<std::size_t>{};
}

}  // namespace

std::vector<std::size_t> ring_outliers(const std::vector<RingPlace>& places, const RingFit& fit,
                                       const Eigen::Vector3d& along) {
  constexpr double least_m = 0.03, sigmas = 3.0;
  if (places.size() < 5) return {};
  // Square to the axis: the ring's own plane may be that of its wrong points.
  const Eigen::Quaterniond flat_from_site = Eigen::Quaterniond::FromTwoVectors(along, Eigen::Vector3d::UnitZ());
  Flat flat;
  for (const RingPlace& place : places) {
    const Eigen::Vector2d point = (flat_from_site * (place.position - fit.center)).head<2>();
    flat.push_back(point + place.target_offset_m * point.normalized());  // to the surface, as good as it is known
  }
  if (places.size() == 5) return odd_one_of_five(places, along, least_m);
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
    if (distances[i] > std::max(least_m, sigmas * sigma)) off.push_back(i);
  return off.size() + 3 > places.size() ? std::vector<std::size_t>{} : off;
}

}  // namespace adit
