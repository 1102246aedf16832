#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/design/profile.h"
#include "core/foundation/random.h"
#include "tests/core/profile_shapes.h"

namespace adit {
namespace {

/// Distance to the flattened line, and whether the point is inside it (even-odd rule): independent of the arcs.
struct Brute {
  double distance_m;
  bool inside;
};
Brute brute(const Polygon& ring, const Eigen::Vector2d& p) {
  Brute found{std::numeric_limits<double>::infinity(), false};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i];
    const Eigen::Vector2d b = ring[(i + 1) % ring.size()];
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    found.distance_m = std::min(found.distance_m, (a + t * (b - a) - p).norm());
    const bool spans = (a.y() > p.y()) != (b.y() > p.y());
    if (spans && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) found.inside = !found.inside;
  }
  return found;
}

void expect_nearest_like_brute_force(const Profile& profile) {
  const Polygon ring = profile.flattened(1e-6);
  const Random random(17);
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const Eigen::Vector2d p(random.uniform(2 * i, -6, 6), random.uniform(2 * i + 1, -4, 10));
    const ProfileFoot foot = profile.nearest(p);
    const Brute truth = brute(ring, p);
    ASSERT_NEAR(std::abs(foot.deviation_m), truth.distance_m, 2e-6) << p.transpose();
    if (truth.distance_m > 1e-5) {
      ASSERT_EQ(foot.deviation_m < 0, truth.inside) << p.transpose();
      ASSERT_EQ(profile.contains(p), truth.inside);
    }
    EXPECT_NEAR(foot.direction.norm(), 1.0, 1e-12);
    const Eigen::Vector2d back = profile.at(foot.p_m).position + foot.deviation_m * foot.direction;
    EXPECT_LT((back - p).norm(), 1e-9) << p.transpose();
    EXPECT_GE(foot.p_m, -0.5 * profile.length_m());
    EXPECT_LT(foot.p_m, 0.5 * profile.length_m());
  }
}

TEST(NearestOnDesignLine, LikeBruteForceOnEveryShape) {
  expect_nearest_like_brute_force(Profile("circle", shapes::circle(3)));
  expect_nearest_like_brute_force(Profile("rectangle", shapes::rectangle(5, 4)));
  expect_nearest_like_brute_force(Profile("D", shapes::d_shape(3, 2)));
  expect_nearest_like_brute_force(Profile("horseshoe", shapes::horseshoe()));
}

TEST(NearestOnDesignLine, LikeBruteForceOnAManySidedLine) {
  std::vector<ProfileSegment> star;
  const int n = 400;
  const auto point = [](int i) -> Eigen::Vector2d {
    const double a = 2 * pi * i / n;
    const double r = 3 + (i % 2 == 0 ? 0.0 : 0.1);
    return {r * std::cos(a), 2 + r * std::sin(a)};
  };
  for (int i = 0; i < n; ++i) star.push_back({point(i), point((i + 1) % n), 0.0});
  expect_nearest_like_brute_force(Profile("star", star));
}

TEST(NearestOnDesignLine, AnArcOfMoreThanHalfACircle) {
  // A keyhole: three quarters of a circle over a short slot.
  const double r = std::sqrt(2.0);
  const std::vector<ProfileSegment> keyhole{{{1, -2}, {1, -1}, 0},
                                            {{1, -1}, {-1, -1}, std::tan(1.5 * pi / 4)},
                                            {{-1, -1}, {-1, -2}, 0},
                                            {{-1, -2}, {1, -2}, 0}};
  const Profile profile("keyhole", keyhole);
  EXPECT_NEAR(profile.nearest({0, 3}).deviation_m, 3 - r, 1e-12);
  EXPECT_NEAR(profile.nearest({0, 0}).deviation_m, -r, 1e-12);
  expect_nearest_like_brute_force(profile);
}

TEST(NearestOnDesignLine, OutsideAConvexCornerTheCornerItself) {
  const Profile profile("rectangle", shapes::rectangle(5, 4));
  const ProfileFoot foot = profile.nearest({2.5 + 0.3, 4 + 0.4});
  EXPECT_NEAR(foot.deviation_m, 0.5, 1e-12);
  EXPECT_NEAR(foot.direction.x(), 0.6, 1e-12);
  ASSERT_GE(foot.corner, 0);
  EXPECT_LT((profile.corners()[static_cast<std::size_t>(foot.corner)].position - Eigen::Vector2d(2.5, 4)).norm(),
            1e-12);
  EXPECT_EQ(profile.nearest({0, 4.5}).corner, -1);
}

TEST(NearestOnDesignLine, InsideAHollowCornerTheDeviationIsNegative) {
  // An L: the hollow corner at (1, 1) is nearest to points inside, towards the origin.
  const std::vector<ProfileSegment> bend{{{0, 0}, {3, 0}, 0}, {{3, 0}, {3, 1}, 0}, {{3, 1}, {1, 1}, 0},
                                         {{1, 1}, {1, 3}, 0}, {{1, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  const Profile profile("L", bend);
  const ProfileFoot foot = profile.nearest({0.8, 0.8});
  EXPECT_NEAR(foot.deviation_m, -0.2 * std::sqrt(2.0), 1e-12);
  ASSERT_GE(foot.corner, 0);
  EXPECT_NEAR(profile.corners()[static_cast<std::size_t>(foot.corner)].turn_rad, -pi / 2, 1e-12);
}

TEST(NearestOnDesignLine, OnTheLineTheNormalServes) {
  const Profile profile("D", shapes::d_shape(3, 2));
  for (double p = -0.49 * profile.length_m(); p < 0.5 * profile.length_m(); p += 0.21) {
    const ProfilePoint at = profile.at(p);
    const ProfileFoot foot = profile.nearest(at.position);
    EXPECT_NEAR(foot.deviation_m, 0.0, 1e-12);
    EXPECT_NEAR(foot.p_m, p, 1e-9);
    EXPECT_GT(foot.direction.dot(at.normal), 0.999);
  }
}

}  // namespace
}  // namespace adit
