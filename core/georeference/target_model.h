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
  double bleed;             ///< how many of them white creeps over the edges of black: too much light, or a gamma

  /// From that of the picture. `shape`: pixels for one outer radius.
  TargetBlur(double sigma_px, double bleeding, const Eigen::Matrix2d& shape);
};

/// How much of the light at a place the black of each part takes away, 0 to 1 each. Edges are straight over the spread.
struct TargetDarkness {
  double disc = 0.0;
  std::array<double, coded_pattern::segments> segments{};
};
TargetDarkness darkness_at(const PatternPlace& place, const TargetBlur& blur);

/// How much of the light is taken away, and how that changes.
struct Shade {
  double value = 0.0;
  double by_log_blur = 0.0;  ///< per small share by which the blur grows
  double by_bleed = 0.0;
};

/// Of disc and segments together, each segment as dark as that: 0 as the paper, 1 as the disc. White creeps over the
/// ends of black, not into what is black all through.
using Blackness = std::array<double, coded_pattern::segments>;
Shade shade_of(const Blackness& blackness, const PatternPlace& place, const TargetBlur& blur);

/// Of the disc alone, for places inside the segments.
Shade disc_shade_at(const PatternPlace& place, const TargetBlur& blur);

/// Of the four quarters of the disc, the white one first, counter-clockwise: as if each were black.
std::array<double, 4> quarters_at(const PatternPlace& place, const TargetBlur& blur);

}  // namespace adit
