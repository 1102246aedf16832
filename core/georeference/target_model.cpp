#include "core/georeference/target_model.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"

namespace adit {
namespace {

using coded_pattern::segments;

constexpr double one_segment_rad = 2.0 * pi / segments;

/// Share of a blurred half plane that lies beyond its edge, by how many sigmas it is away: to 2e-6. And its slope.
class StepTable {
 public:
  struct Step {
    double value, slope;
  };
  StepTable() {
    for (std::size_t i = 0; i < values_.size(); ++i)
      values_[i] = 0.5 * std::erfc(-(static_cast<double>(i) / per_sigma - most) * 0.70710678118654752);
  }
  double operator()(double sigmas) const { return at(sigmas).value; }
  Step at(double sigmas) const {
    if (!(sigmas < most)) return {1.0, 0.0};
    if (sigmas <= -most) return {0.0, 0.0};
    const double place = (sigmas + most) * per_sigma;
    const auto cell = static_cast<std::size_t>(place);
    const double rise = values_[cell + 1] - values_[cell];
    return {values_[cell] + (place - static_cast<double>(cell)) * rise, per_sigma * rise};
  }

 private:
  static constexpr double most = 4.0, per_sigma = 128.0;
  std::array<double, static_cast<std::size_t>(2.0 * most * per_sigma) + 2> values_{};
};
const StepTable step;

/// Beyond an edge `sigmas` away, which bleeding moves by `moved` of its own.
Shade edge_at(double sigmas, double moved, double bleed) {
  const StepTable::Step at = step.at(sigmas + moved * bleed);
  return {at.value, -sigmas * at.slope, moved * at.slope};
}

Shade operator*(const Shade& a, const Shade& b) {
  return {a.value * b.value, a.by_log_blur * b.value + a.value * b.by_log_blur,
          a.by_bleed * b.value + a.value * b.by_bleed};
}

Shade operator+(const Shade& a, const Shade& b) {
  return {a.value + b.value, a.by_log_blur + b.by_log_blur, a.by_bleed + b.by_bleed};
}

Shade operator*(double factor, const Shade& a) {
  return {factor * a.value, factor * a.by_log_blur, factor * a.by_bleed};
}

double across_edge(const PatternPlace& place, const TargetBlur& blur) {
  return std::sqrt(place.outwards.dot(blur.covariance * place.outwards));
}

/// Of the disc, whose rim is blurred by `across` there.
Shade disc_shade(const PatternPlace& place, const TargetBlur& blur, double across) {
  const Shade inside = edge_at((coded_pattern::disc_radius - place.radius) / across, -1.0, blur.bleed);
  if (inside.value <= 0.0) return {};
  const Shade right = edge_at(place.at.x() / blur.along_x, 1.0, blur.bleed);
  const Shade up = edge_at(place.at.y() / blur.along_y, 1.0, blur.bleed);
  return inside * (Shade{1.0, 0.0, 0.0} + -1.0 * (right * up));
}

}  // namespace

PatternPlace::PatternPlace(const Eigen::Vector2d& place)
    : at(place), radius(std::max(1e-9, place.norm())), outwards(place / radius), turn(0.0) {
  if (outwards.isZero()) outwards = Eigen::Vector2d::UnitX();  // any direction does in the middle
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

Shade disc_shade_at(const PatternPlace& place, const TargetBlur& blur) {
  return disc_shade(place, blur, across_edge(place, blur));
}

std::array<double, 4> quarters_at(const PatternPlace& place, const TargetBlur& blur) {
  const double across = across_edge(place, blur);
  const double inside = step((coded_pattern::disc_radius - place.radius) / across - blur.bleed);
  const double right = step(place.at.x() / blur.along_x + blur.bleed),
               up = step(place.at.y() / blur.along_y + blur.bleed);
  return {inside * right * up, inside * (1.0 - right) * up, inside * (1.0 - right) * (1.0 - up),
          inside * right * (1.0 - up)};
}

namespace {

constexpr double nothing = 1e-6;

/// Share of the light of a place that the ring of segments sends.
Shade ring_share(const PatternPlace& place, const TargetBlur& blur, double across) {
  const Shade inner = edge_at((place.radius - coded_pattern::ring_radius) / across, -1.0, blur.bleed);
  if (inner.value <= nothing) return {};
  const Shade outer = edge_at((1.0 - place.radius) / across, -1.0, blur.bleed);
  const Shade share = inner + outer + Shade{-1.0, 0.0, 0.0};
  return share.value > nothing ? share : Shade{};
}

/// Where a place lies among the segments.
struct InRing {
  double per_segment;  ///< sigmas
  int reach;           ///< boundaries that far away may matter
  int here;            ///< segment

  InRing(const PatternPlace& place, const TargetBlur& blur) {
    const Eigen::Vector2d around(-place.outwards.y(), place.outwards.x());
    per_segment = place.radius * one_segment_rad / std::sqrt(around.dot(blur.covariance * around));
    constexpr double most = segments / 2 - 1;  // also where a fit on its way makes segments ever so narrow
    reach = static_cast<int>(std::min(most, (4.0 + std::abs(blur.bleed)) / per_segment + 1.0));
    here = static_cast<int>(place.turn) % segments;
  }
};

std::size_t wrapped(int segment) {
  return static_cast<std::size_t>((segment + segments) % segments);
}

}  // namespace

TargetDarkness darkness_at(const PatternPlace& place, const TargetBlur& blur) {
  const double across = across_edge(place, blur);
  TargetDarkness darkness;
  darkness.disc = disc_shade(place, blur, across).value;
  const double share = ring_share(place, blur, across).value;
  if (share <= 0.0) return darkness;
  const InRing ring(place, blur);
  // Of the segment that begins at b, the share step(turn - b) - step(turn - b - 1).
  double before = step((place.turn - ring.here + ring.reach) * ring.per_segment);
  for (int k = -ring.reach; k <= ring.reach; ++k) {
    const double behind = step((place.turn - ring.here - k - 1) * ring.per_segment);
    darkness.segments[wrapped(ring.here + k)] += share * (before - behind);
    before = behind;
  }
  return darkness;
}

Shade shade_of(const Blackness& blackness, const PatternPlace& place, const TargetBlur& blur) {
  const double across = across_edge(place, blur);
  const Shade disc = disc_shade(place, blur, across);
  const Shade share = ring_share(place, blur, across);
  if (share.value <= 0.0) return disc;
  const InRing ring(place, blur);
  // From boundary to boundary, each moved into the darker side.
  std::size_t segment = wrapped(ring.here - ring.reach - 1);
  Shade dark{blackness[segment], 0.0, 0.0};
  for (int k = -ring.reach; k <= ring.reach + 1; ++k) {
    const double before = blackness[segment];
    segment = segment + 1 == segments ? 0 : segment + 1;
    const double change = blackness[segment] - before;
    if (change == 0.0) continue;
    const double sigmas = (place.turn - ring.here - k) * ring.per_segment;
    dark = dark + change * edge_at(sigmas, change > 0.0 ? -1.0 : 1.0, blur.bleed);
  }
  return dark.value > 0.0 ? disc + share * dark : disc;
}

}  // namespace adit
