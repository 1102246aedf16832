#include "core/design/section_plane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/random.h"
#include "core/profiling/profiling.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

/// 120 m, right-hand curve or straight, with a steep grade and, on request, a vertical curve from 8 to 14 %.
Alignment steep_axis(double radius_m, bool bends) {
  const Alignment level = tests::sample_axis(radius_m);
  std::vector<VerticalPoint> grade{{0.0, 0.0}, {120.0, 14.4}};
  if (bends) grade = {{0.0, 0.0}, {60.0, 4.8, VerticalCurveKind::parabola, 60.0, 0.0}, {120.0, 13.2}};
  return {"steep", level.horizontal(), VerticalAlignment(grade)};
}

TEST(SectionPlane, PlacesComeBackToAHundredthOfAMillimetre) {
  const Random random(4, 4);
  for (const double radius_m : {0.0, 60.0, -45.0})
    for (const bool bends : {false, true}) {
      const Alignment axis = steep_axis(radius_m, bends);
      for (std::uint64_t i = 0; i < 2000; ++i) {
        const TunnelPoint square{random.uniform(3 * i, 10.0, 110.0), random.uniform(3 * i + 1, -6.0, 6.0),
                                 random.uniform(3 * i + 2, -2.0, 9.0)};
        const Eigen::Vector3d site = site_of_square(axis, square);
        const auto vertical = axis.to_tunnel(site);
        ASSERT_TRUE(vertical);
        const TunnelPoint back = square_from_vertical(axis, *vertical);
        ASSERT_LT(std::hypot(back.s_m - square.s_m, back.x_m - square.x_m, back.z_m - square.z_m), 1e-5);
        // The plane through it is square to the axis in space.
        const PlanPoint plan = axis.horizontal().at(square.s_m);
        const double g = axis.vertical().at(square.s_m).grade;
        const Eigen::Vector3d ahead = Eigen::Vector3d(plan.tangent().x(), plan.tangent().y(), g).normalized();
        ASSERT_NEAR((site - axis.to_site({square.s_m, 0.0, 0.0})).dot(ahead), 0.0, 1e-9);
      }
    }
}

/// A round bore square to the axis in space, sampled densely, with its deviation from the profile.
std::vector<PlacedTiles> bore(const DesignTunnel& design, double radius_m) {
  PointCloud cloud;
  for (int i = 0; i < 500; ++i)
    for (int j = 0; j < 800; ++j) {
      const double angle = 2.0 * pi * (j + 0.37 * (i % 3)) / 800.0, s = 25.0 + 0.04 * i;
      const TunnelPoint place{s, radius_m * std::sin(angle), radius_m * std::cos(angle)};
      cloud.points.push_back(site_of_square(design.alignment(), place).cast<float>());
    }
  return {{"S", std::make_shared<CloudTiles>(std::move(cloud)), Pose::Identity(), false}};
}

TEST(SectionPlane, ABoreSquareToASteepAxisMeetsItsCircleAndItsClosedFormVolume) {
  Progress progress;
  constexpr double radius = 4.0, over = 0.1, from = 30.0, to = 40.0;
  for (const double curve_m : {0.0, 60.0}) {
    const DesignTunnel vertical(steep_axis(curve_m, false), {{0.0, tests::circle_profile(radius)}}, {DesignLine{}});
    const DesignTunnel square = vertical.standing(SectionPlane::square);
    const auto scans = bore(vertical, radius + over);
    const MapResult mapped = map_deviations(scans, square, from, to, {}, progress);
    const Volume volume = compute_volume(mapped.map, square, {"excavation", 0.0}, from, to, 1.0, {}, {}, progress);
    // A circle about the axis: Guldin, along the axis in space.
    const double length = (to - from) * std::hypot(1.0, 0.12);
    const double exact = pi * (radius + over) * (radius + over) * length;
    EXPECT_NEAR(volume.slices.excavated_m3, exact, 3e-4 * exact);
    EXPECT_NEAR(volume.slices.overbreak_m3, exact - pi * radius * radius * length, 0.003 * exact);
    EXPECT_NEAR(volume.closure_m3, 0.0, 1e-5);
    const SectionAreas areas = cut_section(mapped.map, square, 35.05, {}).lines.front();
    EXPECT_NEAR(areas.max_overbreak_m, over, 0.003);
    EXPECT_EQ(cut_section(mapped.map, square, 35.05, {}).plane, SectionPlane::square);

    // In vertical planes the same bore is an ellipse, taller by one over the cosine; the rock is the same.
    const MapResult upright = map_deviations(scans, vertical, from, to, {}, progress);
    const SectionAreas seen = cut_section(upright.map, vertical, 35.05, {}).lines.front();
    EXPECT_NEAR(seen.area_m2, pi * (radius + over) * (radius + over) * std::hypot(1.0, 0.12), 0.02);
  }
}

}  // namespace
}  // namespace adit
