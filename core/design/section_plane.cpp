#include "core/design/section_plane.h"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

/// The axis at a chainage: place, directions ahead (level), right and along the grade.
struct Frame {
  Eigen::Vector2d position, ahead;
  double elevation_m, slope_rad, curvature_per_m;

  Frame(const Alignment& axis, double s_m) {
    const PlanPoint plan = axis.horizontal().at(s_m);
    const auto grade = axis.vertical().at(s_m);
    position = plan.position;
    ahead = plan.tangent();
    elevation_m = grade.elevation_m;
    slope_rad = std::atan(grade.grade);
    curvature_per_m = plan.curvature_per_m;
  }
  Eigen::Vector2d right() const { return {ahead.y(), -ahead.x()}; }
};

}  // namespace

TunnelPoint square_from_vertical(const Alignment& axis, const TunnelPoint& vertical) {
  constexpr int most_turns = 20;
  constexpr double exact_m = 1e-7;
  const Frame foot(axis, vertical.s_m);
  const Eigen::Vector2d place = foot.position + vertical.x_m * foot.right();
  const double elevation_m = foot.elevation_m + vertical.z_m;
  double s_m = vertical.s_m;
  for (int turn = 0; turn < most_turns; ++turn) {
    const Frame here(axis, s_m);
    const Eigen::Vector2d away = place - here.position;
    const double ahead_m = away.dot(here.ahead), right_m = away.dot(here.right());
    const double up_m = elevation_m - here.elevation_m;
    const double sine = std::sin(here.slope_rad), cosine = std::cos(here.slope_rad);
    const double off_m = ahead_m * cosine + up_m * sine;  // before the plane
    const double step_m = off_m / ((1.0 - here.curvature_per_m * right_m) * cosine + sine * sine / cosine);
    const double next_m = std::clamp(s_m + step_m, axis.from_m(), axis.to_m());
    if (std::abs(next_m - s_m) < exact_m || turn + 1 == most_turns)
      return {next_m, right_m, up_m * cosine - ahead_m * sine};
    s_m = next_m;
  }
  return vertical;
}

Eigen::Vector3d site_of_square(const Alignment& axis, const TunnelPoint& square) {
  const Frame here(axis, square.s_m);
  const Eigen::Vector2d plan =
      here.position + square.x_m * here.right() - square.z_m * std::sin(here.slope_rad) * here.ahead;
  return {plan.x(), plan.y(), here.elevation_m + square.z_m * std::cos(here.slope_rad)};
}

SliceShape slice_shape(const Alignment& axis, SectionPlane plane, double chainage_m) {
  const double k = axis.horizontal().at(chainage_m).curvature_per_m;
  if (plane == SectionPlane::vertical) return {1.0, k, 0.0};
  constexpr double half_m = 0.05;
  const double before_m = std::max(axis.from_m(), chainage_m - half_m);
  const double behind_m = std::min(axis.to_m(), chainage_m + half_m);
  const auto slope = [&](double s_m) { return std::atan(axis.vertical().at(s_m).grade); };
  const double cosine = std::cos(slope(chainage_m));
  return {1.0 / cosine, k * cosine, (slope(behind_m) - slope(before_m)) / (behind_m - before_m)};
}

}  // namespace adit
