#include "core/design/profile_blend.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double spacing_m = 0.05;

bool alike(const Profile& a, const Profile& b) {
  if (a.segments().size() != b.segments().size()) return false;
  for (std::size_t i = 0; i < a.segments().size(); ++i)
    if ((a.segments()[i].bulge == 0.0) != (b.segments()[i].bulge == 0.0)) return false;
  return true;
}

/// Shares of the length, -1/2 to 1/2, at which the blend gets its corners.
std::vector<double> shares_of(const Profile& a, const Profile& b) {
  const double length = std::max(a.length_m(), b.length_m());
  const auto n = static_cast<std::size_t>(std::ceil(length / spacing_m));
  std::vector<double> shares;
  for (std::size_t i = 0; i < n; ++i) shares.push_back(static_cast<double>(i) / static_cast<double>(n) - 0.5);
  for (const Profile* profile : {&a, &b})
    for (const ProfileCorner& corner : profile->corners()) shares.push_back(corner.p_m / profile->length_m());
  std::sort(shares.begin(), shares.end());
  constexpr double same = 1e-6;
  shares.erase(std::unique(shares.begin(), shares.end(), [](double x, double y) { return y - x < same; }),
               shares.end());
  if (shares.size() > 1 && shares.front() + 1.0 - shares.back() < same) shares.pop_back();
  return shares;
}

Eigen::Vector2d between(const Profile& a, const Profile& b, double share_of_length, double share) {
  return (1.0 - share) * a.at(share_of_length * a.length_m()).position +
         share * b.at(share_of_length * b.length_m()).position;
}

}  // namespace

Profile blended_profile(const Profile& from, const Profile& to, double share) {
  const std::string name = from.name() + " to " + to.name();
  std::vector<ProfileSegment> segments;
  if (alike(from, to)) {
    for (std::size_t i = 0; i < from.segments().size(); ++i) {
      const ProfileSegment &a = from.segments()[i], &b = to.segments()[i];
      segments.push_back({(1.0 - share) * a.start + share * b.start, (1.0 - share) * a.end + share * b.end,
                          (1.0 - share) * a.bulge + share * b.bulge});
    }
    return Profile(name, segments);
  }
  const std::vector<double> shares = shares_of(from, to);
  for (std::size_t i = 0; i < shares.size(); ++i)
    segments.push_back(
        {between(from, to, shares[i], share), between(from, to, shares[(i + 1) % shares.size()], share)});
  return Profile(name, segments);
}

Profile turned_profile(const Profile& profile, double turn_rad, double rise_m) {
  const Eigen::Rotation2Dd turn(-turn_rad);
  std::vector<ProfileSegment> segments;
  for (const ProfileSegment& segment : profile.segments())
    segments.push_back({turn * segment.start + Eigen::Vector2d(0.0, rise_m),
                        turn * segment.end + Eigen::Vector2d(0.0, rise_m), segment.bulge});
  return Profile(profile.name(), segments);
}

double blend_distance_m(const Profile& from, const Profile& to) {
  double farthest = 0.0;
  for (const double share : shares_of(from, to))
    farthest =
        std::max(farthest, (from.at(share * from.length_m()).position - to.at(share * to.length_m()).position).norm());
  return farthest;
}

}  // namespace adit
