#include "core/design/profile_piece.h"

#include <algorithm>
#include <vector>

#include "core/foundation/angle.h"

namespace adit {
namespace {

constexpr double flattest_sagitta_m = 1e-9;

Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// Area between an arc and its chord, positive for a counter-clockwise arc.
double cap_area_m2(const ProfileSegment& segment) {
  if (segment.bulge == 0.0) return 0.0;
  const double sweep = 4.0 * std::atan(segment.bulge);
  const double chord = (segment.end - segment.start).norm();
  const double radius = chord * (1.0 + segment.bulge * segment.bulge) / (4.0 * std::abs(segment.bulge));
  const double sweep_less_sine =
      std::abs(sweep) < 0.02 ? std::pow(sweep, 3) / 6.0 * (1.0 - sweep * sweep / 20.0) : sweep - std::sin(sweep);
  return 0.5 * radius * radius * sweep_less_sine;
}

}  // namespace

ProfilePiece::ProfilePiece(const ProfileSegment& segment) : start(segment.start), end(segment.end) {
  const Eigen::Vector2d chord = end - start;
  const double width = chord.norm();
  const double bulge = segment.bulge;
  tangent = chord / width;
  radial = left_of(tangent);  // the inside of a clockwise line lies to its right
  middle = 0.5 * (start + end);
  half_length_m = 0.5 * width;
  if (std::abs(bulge) * 0.5 * width < flattest_sagitta_m) return;
  outward = bulge < 0.0 ? 1.0 : -1.0;
  radial *= outward;
  middle += 0.5 * width * std::abs(bulge) * radial;
  radius_m = width * (1.0 + bulge * bulge) / (4.0 * std::abs(bulge));
  half_sweep_rad = 2.0 * std::atan(std::abs(bulge));
  sine_of_half_sweep = std::sin(half_sweep_rad);
  half_length_m = radius_m * half_sweep_rad;
}

Eigen::Vector2d ProfilePiece::position(double along_m) const {
  if (!is_arc()) return middle + along_m * tangent;
  const double angle = along_m / radius_m;
  const double half_sine = std::sin(0.5 * angle);
  return middle + radius_m * (std::sin(angle) * tangent - 2.0 * half_sine * half_sine * radial);
}

Eigen::Vector2d ProfilePiece::normal(double along_m) const {
  if (!is_arc()) return radial;
  const double angle = along_m / radius_m;
  return outward * (std::cos(angle) * radial + std::sin(angle) * tangent);
}

Eigen::AlignedBox2d ProfilePiece::box() const {
  Eigen::AlignedBox2d box(start);
  box.extend(end);
  if (!is_arc()) return box;
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}) {
    for (const double sign : {-1.0, 1.0}) {
      const double angle = std::atan2(sign * axis.dot(tangent), sign * axis.dot(radial));
      if (std::abs(angle) <= half_sweep_rad) box.extend(position(angle * radius_m));
    }
  }
  return box;
}

ProfileSegment ProfilePiece::part(double from_along_m, double to_along_m) const {
  const auto place = [this](double along) -> Eigen::Vector2d {
    if (along <= -half_length_m) return start;
    return along >= half_length_m ? end : position(along);
  };
  ProfileSegment segment{place(from_along_m), place(to_along_m), 0.0};
  if (is_arc()) segment.bulge = -outward * std::tan(0.25 * (to_along_m - from_along_m) / radius_m);
  return segment;
}

double signed_area_m2(const std::vector<ProfileSegment>& ring) {
  double area = 0.0;
  if (ring.empty()) return area;
  const Eigen::Vector2d origin = ring.front().start;
  for (const ProfileSegment& segment : ring) {
    const Eigen::Vector2d a = segment.start - origin;
    const Eigen::Vector2d b = segment.end - origin;
    area += 0.5 * (a.x() * b.y() - a.y() * b.x()) + cap_area_m2(segment);
  }
  return area;
}

}  // namespace adit
