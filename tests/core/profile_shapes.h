#pragma once
// Design lines of known size, counter-clockwise from the floor, for the tests of the profile.

#include <cmath>
#include <vector>

#include "core/design/profile.h"

namespace adit::shapes {

inline constexpr double hollow_radius_m = 6.0;

inline std::vector<ProfileSegment> rectangle(double width_m, double height_m) {
  const double w = width_m / 2;
  return {{{-w, 0}, {w, 0}, 0},
          {{w, 0}, {w, height_m}, 0},
          {{w, height_m}, {-w, height_m}, 0},
          {{-w, height_m}, {-w, 0}, 0}};
}

inline std::vector<ProfileSegment> circle(double radius_m) {
  return {{{-radius_m, 0}, {radius_m, 0}, 1.0}, {{radius_m, 0}, {-radius_m, 0}, 1.0}};
}

/// Straight walls, a half circle above.
inline std::vector<ProfileSegment> d_shape(double radius_m, double wall_m) {
  const double r = radius_m;
  return {{{r, 0}, {r, wall_m}, 0}, {{r, wall_m}, {-r, wall_m}, 1.0}, {{-r, wall_m}, {-r, 0}, 0}, {{-r, 0}, {r, 0}, 0}};
}

/// Three-centred arch on curved walls over a floor that bulges upwards: convex and hollow corners and arcs.
inline std::vector<ProfileSegment> horseshoe() {
  const double floor_bulge = -std::tan(0.5 * std::asin(2.0 / hollow_radius_m));
  return {{{-2, 0}, {2, 0}, floor_bulge},  // clockwise on a counter-clockwise line: hollow
          {{2, 0}, {3, 0}, 0},
          {{3, 0}, {3, 3}, 0.1},
          {{3, 3}, {-3, 3}, 0.8},
          {{-3, 3}, {-3, 0}, 0.1},
          {{-3, 0}, {-2, 0}, 0}};
}

inline std::vector<ProfileSegment> backwards(const std::vector<ProfileSegment>& ring) {
  std::vector<ProfileSegment> back;
  for (auto s = ring.rbegin(); s != ring.rend(); ++s) back.push_back({s->end, s->start, -s->bulge});
  return back;
}

}  // namespace adit::shapes
