#include "core/design/design_tunnel.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/design/profile_blend.h"
#include "core/foundation/error.h"
#include "tests/core/profile_shapes.h"

namespace adit {
namespace {

Alignment straight() {
  HorizontalElement line{HorizontalKind::line, "Line 1", {600, 300}, 0.0, 100.0, 0.0, 0.0};
  return Alignment(
      "a", HorizontalAlignment({line}, 0.0),
      VerticalAlignment({{0, 40, VerticalCurveKind::none, 0, 0}, {100, 40, VerticalCurveKind::none, 0, 0}}));
}

Profile named(const std::string& name, double radius_m) {
  return Profile(name, shapes::circle(radius_m));
}

TEST(Design, ProfilesHoldUpToTheNext) {
  const DesignTunnel design(straight(), {{10, named("narrow", 2)}, {50, named("wide", 3)}}, {{}});
  EXPECT_EQ(design.profile_at(10).name(), "narrow");
  EXPECT_EQ(design.profile_at(49.999).name(), "narrow");
  EXPECT_EQ(design.profile_at(50).name(), "wide");
  EXPECT_EQ(design.profile_at(1e6).name(), "wide");
  EXPECT_EQ(design.profile_at(0).name(), "narrow");
}

TEST(Design, MovesWithTheOrigin) {
  const DesignTunnel design(straight(), {{0, named("narrow", 2)}}, {{"excavation", 0.0}, {"pay", 0.25}});
  const DesignTunnel moved = design.relative_to({600, 300, 40});
  EXPECT_LT(moved.alignment().to_site({20, 1, 2}).x() - 1.0, 1e-12);
  EXPECT_NEAR(moved.alignment().to_site({20, 1, 2}).z(), 2.0, 1e-12);
  EXPECT_EQ(moved.lines().size(), 2U);
}

TEST(Design, RefusesAnIncompleteOrDisorderlyDesign) {
  EXPECT_THROW(DesignTunnel(straight(), {}, {{}}), Error);
  EXPECT_THROW(DesignTunnel(straight(), {{0, named("a", 2)}}, {}), Error);
  EXPECT_THROW(DesignTunnel(straight(), {{0, Profile()}}, {{}}), Error);
  EXPECT_THROW(DesignTunnel(straight(), {{50, named("a", 2)}, {10, named("b", 2)}}, {{}}), Error);
  EXPECT_THROW(DesignTunnel(straight(), {{0, named("a", 2)}}, {{"pay", 0.0}, {"pay", 0.2}}), Error);
}

Profile box(double width, double height) {
  return {"box",
          {{{-width / 2, 0}, {-width / 2, height}, 0},
           {{-width / 2, height}, {width / 2, height}, 0},
           {{width / 2, height}, {width / 2, 0}, 0},
           {{width / 2, 0}, {-width / 2, 0}, 0}}};
}

TEST(DesignTunnelBlend, LikeProfilesChangeEvenly) {
  const DesignTunnel tunnel(straight(), {{0, box(4, 3)}, {20, box(4, 3), true}, {30, box(6, 4)}}, {{"line", 0}});
  EXPECT_NEAR(tunnel.profile_at(10).area_m2(), 12, 1e-9);
  EXPECT_NEAR(tunnel.profile_at(40).area_m2(), 24, 1e-9);
  for (const double s : {20.5, 25.0, 29.2}) {
    const double share = (s - 20) / 10;
    EXPECT_NEAR(tunnel.profile_at(s).area_m2(), (4 + 2 * share) * (3 + share), 0.1) << s;
    EXPECT_EQ(tunnel.profile_at(s).segments().size(), tunnel.profile_at(10).segments().size());
  }
  EXPECT_THROW(DesignTunnel(straight(), {{0, box(4, 3), true}}, {{"line", 0}}), Error);
}

TEST(DesignTunnelBlend, EndsAndWholeStepsAreExact) {
  const DesignTunnel tunnel(straight(), {{20, box(4, 3), true}, {30, box(6, 4)}}, {{"line", 0}});
  EXPECT_NEAR(tunnel.profile_at(20).area_m2(), 12.0, 1e-9);
  EXPECT_NEAR(tunnel.profile_at(25).area_m2(), 5.0 * 3.5, 1e-9);
  EXPECT_NEAR(tunnel.profile_at(29.9999).area_m2(), 24.0, 1e-9);
  double sum = 0.0;
  for (double s = 20.005; s < 30.0; s += 0.01) sum += 0.01 * tunnel.profile_at(s).area_m2();
  EXPECT_NEAR(sum, 10.0 * (12.0 + 10.0 / 2.0 + 2.0 / 3.0), 0.01);  // of (4 + 2 u)(3 + u), u from 0 to 1
}

TEST(DesignTunnelBlend, UnlikeProfilesMeetBothEnds) {
  const Profile circle("circle", {{{-3, 0}, {3, 0}, -1}, {{3, 0}, {-3, 0}, -1}});
  const Profile rectangle = box(6, 6);
  EXPECT_NEAR(blended_profile(circle, rectangle, 0.0).area_m2(), circle.area_m2(), 0.01);
  EXPECT_NEAR(blended_profile(circle, rectangle, 1.0).area_m2(), 36.0, 1e-6);
  const double half = blended_profile(circle, rectangle, 0.5).area_m2();
  EXPECT_GT(half, circle.area_m2());
  EXPECT_LT(half, 36.0);
}

TEST(DesignTunnelCant, ProfilesTurnAndRiseWithTheCant) {
  const Alignment axis("a", straight().horizontal(), straight().vertical(), {},
                       Cant({{20, 0, 0}, {40, 0.15, 0}, {100, 0.15, 0}}, 1.5));
  const DesignTunnel tunnel(axis, {{0, box(4, 3)}}, {{"line", 0}}, true);
  const auto corner = [&](double s) { return tunnel.profile_at(s).nearest({2.0, 0.0}); };
  EXPECT_NEAR(corner(10).deviation_m, 0.0, 1e-9);
  const double turn = std::asin(0.1);
  // The right floor corner stands lower, the left one higher, the middle raised by half the cant.
  for (const Eigen::Vector2d& place : {Eigen::Vector2d(2, 0), Eigen::Vector2d(-2, 0), Eigen::Vector2d(-2, 3)}) {
    const Eigen::Vector2d there(place.x() * std::cos(turn) + place.y() * std::sin(turn),
                                0.075 + place.y() * std::cos(turn) - place.x() * std::sin(turn));
    EXPECT_NEAR(tunnel.profile_at(60).nearest(there).deviation_m, 0.0, 1e-9);
  }
  const double half = std::asin(0.05);
  EXPECT_NEAR(tunnel.profile_at(30).nearest({2 * std::cos(half), 0.0375 - 2 * std::sin(half)}).deviation_m, 0.0, 0.001);
  EXPECT_NEAR(tunnel.profile_at(60).area_m2(), 12.0, 1e-9);
  EXPECT_NEAR(DesignTunnel(axis, {{0, box(4, 3)}}, {{"line", 0}}).profile_at(60).nearest({2.0, 0.0}).deviation_m, 0.0,
              1e-9);
}

}  // namespace
}  // namespace adit
