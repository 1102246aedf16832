#include "core/design/alignment.h"

#include <gtest/gtest.h>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"

namespace adit {
namespace {

Alignment curved_axis(const Eigen::Vector2d& start = {0, 0}) {
  HorizontalElement spiral{HorizontalKind::clothoid, "Spiral 1", start, 1.1, 90.0, 0.0, 1.0 / 300};
  const PlanPoint end = element_point(spiral, 90.0);
  HorizontalElement arc{HorizontalKind::arc, "Curve 2", end.position, end.azimuth_rad, 110.0, 1.0 / 300, 1.0 / 300};
  VerticalAlignment grade({{1000, 410, VerticalCurveKind::none, 0, 0},
                           {1090, 413, VerticalCurveKind::circle, 0, 2500},
                           {1195, 410, VerticalCurveKind::none, 0, 0}});
  return Alignment("north tube", HorizontalAlignment({spiral, arc}, 1000.0), std::move(grade));
}

TEST(Axis, ThereAndBackInThreeDimensions) {
  const Alignment axis = curved_axis();
  EXPECT_DOUBLE_EQ(axis.from_m(), 1000.0);
  EXPECT_DOUBLE_EQ(axis.to_m(), 1195.0);  // the grade line ends before the plan does
  for (double s = 1000.0; s <= 1195.0; s += 4.7) {
    const TunnelPoint truth{s, -3.2, 5.6};
    const auto back = axis.to_tunnel(axis.to_site(truth), s + 1.0);
    ASSERT_TRUE(back.has_value());
    EXPECT_NEAR(back->s_m, truth.s_m, 1e-9);
    EXPECT_NEAR(back->x_m, truth.x_m, 1e-9);
    EXPECT_NEAR(back->z_m, truth.z_m, 1e-9);
  }
}

TEST(Axis, OffsetIsToTheRightAndHeightAboveTheGradeLine) {
  HorizontalElement north{HorizontalKind::line, "Line 1", {500, 100}, 0.0, 50.0, 0.0, 0.0};
  const Alignment axis(
      "a", HorizontalAlignment({north}, 0.0),
      VerticalAlignment({{0, 10, VerticalCurveKind::none, 0, 0}, {50, 15, VerticalCurveKind::none, 0, 0}}));
  const auto east_of_it = axis.to_tunnel({502, 120, 13.5});
  ASSERT_TRUE(east_of_it.has_value());
  EXPECT_NEAR(east_of_it->s_m, 20.0, 1e-12);
  EXPECT_NEAR(east_of_it->x_m, 2.0, 1e-12);
  EXPECT_NEAR(east_of_it->z_m, 1.5, 1e-12);
}

TEST(Axis, NearSwissCoordinatesTheTunnelCoordinatesAreTheSame) {
  const Eigen::Vector3d far(2683026.0, 1251466.0, 0.0);
  const Alignment near_zero = curved_axis();
  const Alignment site = curved_axis(far.head<2>());
  const Alignment local = site.relative_to(far);
  for (double s = 1000.5; s < 1195.0; s += 2.9) {
    const Eigen::Vector3d point = near_zero.to_site({s, 4.2, 3.1});
    for (const auto& found : {site.to_tunnel(point + far, s + 1.5), local.to_tunnel(point, s + 1.5)}) {
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR(found->s_m, s, 1e-5);
      EXPECT_NEAR(found->x_m, 4.2, 1e-5);
      EXPECT_NEAR(found->z_m, 3.1, 1e-5);
    }
  }
}

TEST(Axis, WithoutGradeLineThePlanStillServes) {
  HorizontalElement line{HorizontalKind::line, "Line 1", {0, 0}, 0.0, 50.0, 0.0, 0.0};
  const Alignment axis("a", HorizontalAlignment({line}, 7.0), {});
  EXPECT_DOUBLE_EQ(axis.from_m(), 7.0);
  EXPECT_DOUBLE_EQ(axis.to_m(), 57.0);
  EXPECT_TRUE(axis.horizontal().foot({1, 5}).has_value());
  EXPECT_THROW(axis.to_tunnel({1, 5, 0}), Error);
  EXPECT_THROW(axis.to_site({10, 0, 0}), Error);
}

TEST(Axis, NothingWhereOnlyThePlanIsKnown) {
  const Alignment axis = curved_axis();
  const Eigen::Vector2d plan = axis.horizontal().to_plan({1198.0, 1.0});
  EXPECT_FALSE(axis.to_tunnel({plan.x(), plan.y(), 411.0}, 1197.0).has_value());
  EXPECT_THROW(axis.to_site({1198.0, 1.0, 0.0}), Error);
}

TEST(Axis, OnARampEachPointFindsItsOwnTurn) {
  // Three turns of 20 m radius, 6 m apart in height.
  const double turn_m = 40.0 * pi;
  const HorizontalAlignment plan({{HorizontalKind::arc, "", {0, 0}, 0.0, 3 * turn_m, 0.05, 0.05}}, 0.0);
  const Alignment ramp("ramp", plan, VerticalAlignment({{0, 0}, {3 * turn_m, 18}}));
  for (double s = 3; s < 3 * turn_m - 3; s += 7.3)
    for (const double x : {-2.5, 0.0, 3.0}) {
      const auto back = ramp.to_tunnel(ramp.to_site({s, x, 1.8}));
      ASSERT_TRUE(back.has_value()) << s;
      EXPECT_NEAR(back->s_m, s, 1e-9);
      EXPECT_NEAR(back->x_m, x, 1e-9);
      EXPECT_NEAR(back->z_m, 1.8, 1e-9);
    }
  EXPECT_FALSE(ramp.to_tunnel(ramp.to_site({60, 1, 3.0})).has_value());  // half way between two turns
}

}  // namespace
}  // namespace adit
