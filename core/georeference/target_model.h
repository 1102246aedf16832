#pragma once
// The pattern of a coded target as a blurred picture: how dark each part makes each place.

#include <Eigen/Core>

#include <array>
#include <vector>

#include "core/georeference/coded_pattern.h"

namespace adit {

/// A place of the pattern (x right, y up, over the outer radius), with what its darkness needs again and again.
struct PatternPlace {
  Eigen::Vector2d at;
  double radius;
  Eigen::Vector2d outwards;  ///< unit
  double turn;               ///< counter-clockwise from the baseline, in segments: [0, 12)

  explicit PatternPlace(const Eigen::Vector2d& place);
};

/// An even grid over the places from one radius to another: no closer than pixels, no more than some `across` of them.
/// radius_px: pixels for one outer radius.
std::vector<PatternPlace> pattern_grid(double from_radius, double to_radius, double radius_px, double across);

/// The point spread in the plane of a target: its covariance over the outer radius squared.
struct TargetBlur {
  Eigen::Matrix2d covariance;
  double along_x, along_y;  ///< standard deviations

  /// From that of the picture. `shape`: pixels for one outer radius.
  TargetBlur(double sigma_px, const Eigen::Matrix2d& shape);
};

/// How much of the light at a place the black of each part takes away, 0 to 1 each. Edges are straight over the spread.
struct TargetDarkness {
  double disc = 0.0;
  std::array<double, coded_pattern::segments> segments{};

  /// All together, each segment as dark as that: 0 as the paper, 1 as the disc.
  double of(const std::array<double, coded_pattern::segments>& blackness) const {
    double sum = disc;
    for (std::size_t k = 0; k < segments.size(); ++k) sum += blackness[k] * segments[k];
    return sum;
  }
};
/// wider: the point spread times that.
TargetDarkness darkness_at(const PatternPlace& place, const TargetBlur& blur, double wider = 1.0);

/// Of the disc alone, for places inside the segments.
double disc_darkness_at(const PatternPlace& place, const TargetBlur& blur, double wider = 1.0);

}  // namespace adit
