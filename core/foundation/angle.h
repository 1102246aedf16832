#pragma once
// Radians inside; degrees and gon only through these names.

#include <cmath>
#include <numbers>

namespace adit {

inline constexpr double pi = std::numbers::pi;

constexpr double rad_from_deg(double angle_deg) {
  return angle_deg * pi / 180.0;
}
constexpr double deg_from_rad(double angle_rad) {
  return angle_rad * 180.0 / pi;
}
constexpr double rad_from_gon(double angle_gon) {
  return angle_gon * pi / 200.0;
}
constexpr double gon_from_rad(double angle_rad) {
  return angle_rad * 200.0 / pi;
}

/// The same angle in (-pi, pi].
inline double wrapped_rad(double angle_rad) {
  const double a = std::remainder(angle_rad, 2.0 * pi);
  return a <= -pi ? pi : a;
}

}  // namespace adit
