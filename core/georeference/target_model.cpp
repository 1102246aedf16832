#include "core/georeference/target_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit {
namespace {

using coded_pattern::segments;

constexpr double one_segment_rad = 2.0 * pi / segments;

/// Share of a blurred half plane that lies beyond its edge, by how many sigmas it is away: to 2e-6.
class StepTable {
 public:
  StepTable() {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = 0.5 * std::erfc(-(static_cast<double>(i) / per_sigma - most) * 0.70710678118654752);
  }
  double operator()(double sigmas) const {
    if (!(sigmas < most)) return 1.0;
    if (sigmas <= -most) return 0.0;
    const double place = (sigmas + most) * per_sigma;
    const auto cell = static_cast<std::size_t>(place);
    const double share = place - static_cast<double>(cell);
    return (1.0 - share) * values_[cell] + share * values_[cell + 1];
  }

 private:
  static constexpr double most = 4.0, per_sigma = 128.0;
  std::array<double, static_cast<std::size_t>(2.0 * most * per_sigma) + 2> values_{};
};
const StepTable step;

}  // namespace

PatternPlace::PatternPlace(const Eigen::Vector2d& place)
    : at(place), radius(std::max(1e-9, place.norm())), outwards(place / radius), turn(0.0) {
  turn = std::atan2(at.y(), at.x()) / one_segment_rad;
  if (turn < 0.0) turn += segments;
  if (turn >= segments) turn -= segments;
}

std::vector<PatternPlace> pattern_grid(double from_radius, double to_radius, double radius_px, double across) {
  const double spacing = std::max(1.0 / radius_px, 2.0 * to_radius / across);
  const int half = static_cast<int>(to_radius / spacing);
  std::vector<PatternPlace> places;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) {
      const Eigen::Vector2d at(i * spacing, j * spacing);
      const double squared = at.squaredNorm();
      if (squared <= to_radius * to_radius && squared >= from_radius * from_radius) places.emplace_back(at);
    }
  return places;
}

TargetBlur::TargetBlur(double sigma_px, const Eigen::Matrix2d& shape) {
  constexpr double least = 1e-12;
  const Eigen::Matrix2d inverse = shape.inverse();
  covariance = sigma_px * sigma_px * inverse * inverse.transpose() + least * Eigen::Matrix2d::Identity();
  along_x = std::sqrt(covariance(0, 0));
  along_y = std::sqrt(covariance(1, 1));
}

double disc_darkness_at(const PatternPlace& place, const TargetBlur& blur, double wider) {
  const double across = wider * std::sqrt(place.outwards.dot(blur.covariance * place.outwards));
  const double inside = step((coded_pattern::disc_radius - place.radius) / across);
  if (inside <= 0.0) return 0.0;
  return inside * (1.0 - step(place.at.x() / (wider * blur.along_x)) * step(place.at.y() / (wider * blur.along_y)));
}

TargetDarkness darkness_at(const PatternPlace& place, const TargetBlur& blur, double wider) {
  TargetDarkness darkness;
  darkness.disc = disc_darkness_at(place, blur, wider);
  const Eigen::Vector2d& out = place.outwards;
  const Eigen::Vector2d around(-out.y(), out.x());
  const double across = wider * std::sqrt(out.dot(blur.covariance * out));
  const double in_ring =
      step((place.radius - coded_pattern::ring_radius) / across) - step((place.radius - 1.0) / across);
  if (in_ring <= 1e-6) return darkness;
  const double per_segment =
      place.radius * one_segment_rad / (wider * std::sqrt(around.dot(blur.covariance * around)));  // sigmas
  // Only segments near the place: of the one that begins at b, the share step(turn - b) - step(turn - b - 1).
  const int reach = std::min(segments / 2 - 1, static_cast<int>(4.0 / per_segment) + 1);
  const int here = static_cast<int>(place.turn) % segments;
  double before = step((place.turn - here + reach) * per_segment);
  for (int k = -reach; k <= reach; ++k) {
    const double behind = step((place.turn - here - k - 1) * per_segment);
    darkness.segments[static_cast<std::size_t>((here + k + segments) % segments)] += in_ring * (before - behind);
    before = behind;
  }
  return darkness;
}

}  // namespace adit
