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

TargetBlur::TargetBlur(double sigma_px, double bleeding, const Eigen::Matrix2d& shape) : bleed(bleeding) {
  constexpr double least = 1e-12;
  const Eigen::Matrix2d inverse = shape.inverse();
  covariance = sigma_px * sigma_px * inverse * inverse.transpose() + least * Eigen::Matrix2d::Identity();
  along_x = std::sqrt(covariance(0, 0));
  along_y = std::sqrt(covariance(1, 1));
}

double disc_darkness_at(const PatternPlace& place, const TargetBlur& blur) {
  const double across = std::sqrt(place.outwards.dot(blur.covariance * place.outwards));
  const double inside = step((coded_pattern::disc_radius - place.radius) / across - blur.bleed);
  if (inside <= 0.0) return 0.0;
  return inside *
         (1.0 - step(place.at.x() / blur.along_x + blur.bleed) * step(place.at.y() / blur.along_y + blur.bleed));
}

std::array<double, 4> quarters_at(const PatternPlace& place, const TargetBlur& blur) {
  const double across = std::sqrt(place.outwards.dot(blur.covariance * place.outwards));
  const double inside = step((coded_pattern::disc_radius - place.radius) / across - blur.bleed);
  const double right = step(place.at.x() / blur.along_x + blur.bleed),
               up = step(place.at.y() / blur.along_y + blur.bleed);
  return {inside * right * up, inside * (1.0 - right) * up, inside * (1.0 - right) * (1.0 - up),
          inside * right * (1.0 - up)};
}

namespace {

/// Where a place lies in the ring of segments.
struct InRing {
  double share;        ///< of its light, over the radius
  double per_segment;  ///< sigmas
  int reach;           ///< boundaries that far away may matter
  int here;            ///< segment

  InRing(const PatternPlace& place, const TargetBlur& blur) {
    const Eigen::Vector2d& out = place.outwards;
    const Eigen::Vector2d around(-out.y(), out.x());
    const double across = std::sqrt(out.dot(blur.covariance * out));
    share = std::max(0.0, step((place.radius - coded_pattern::ring_radius) / across - blur.bleed) +
                              step((1.0 - place.radius) / across - blur.bleed) - 1.0);
    per_segment = place.radius * one_segment_rad / std::sqrt(around.dot(blur.covariance * around));
    reach = std::min(segments / 2 - 1, static_cast<int>((4.0 + std::abs(blur.bleed)) / per_segment) + 1);
    here = static_cast<int>(place.turn) % segments;
  }
};

constexpr double nothing = 1e-6;

std::size_t wrapped(int segment) {
  return static_cast<std::size_t>((segment + segments) % segments);
}

}  // namespace

TargetDarkness darkness_at(const PatternPlace& place, const TargetBlur& blur) {
  TargetDarkness darkness;
  darkness.disc = disc_darkness_at(place, blur);
  const InRing ring(place, blur);
  if (ring.share <= nothing) return darkness;
  // Of the segment that begins at b, the share step(turn - b) - step(turn - b - 1).
  double before = step((place.turn - ring.here + ring.reach) * ring.per_segment);
  for (int k = -ring.reach; k <= ring.reach; ++k) {
    const double behind = step((place.turn - ring.here - k - 1) * ring.per_segment);
    darkness.segments[wrapped(ring.here + k)] += ring.share * (before - behind);
    before = behind;
  }
  return darkness;
}

double darkness_of(const Blackness& blackness, const PatternPlace& place, const TargetBlur& blur) {
  const double disc = disc_darkness_at(place, blur);
  const InRing ring(place, blur);
  if (ring.share <= nothing) return disc;
  // From boundary to boundary, each moved into the darker side.
  double dark = blackness[wrapped(ring.here - ring.reach - 1)];
  for (int k = -ring.reach; k <= ring.reach + 1; ++k) {
    const double change = blackness[wrapped(ring.here + k)] - blackness[wrapped(ring.here + k - 1)];
    if (change == 0.0) continue;
    const double moved = change > 0.0 ? -blur.bleed : blur.bleed;
    dark += change * step((place.turn - ring.here - k) * ring.per_segment + moved);
  }
  return disc + ring.share * std::max(0.0, dark);
}

}  // namespace adit
