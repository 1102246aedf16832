#include "core/design/profile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "tests/core/profile_shapes.h"

namespace adit {
namespace {

using namespace shapes;  // NOLINT: shapes for these tests

std::string message_of(const std::vector<ProfileSegment>& segments) {
  try {
    Profile("p", segments);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

void expect_mentions(const std::string& words, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(words.find(part), std::string::npos) << words << "\nlacks: " << part;
}

TEST(DesignLine, CircleHasItsLengthAreaAndCrown) {
  const Profile profile("circle", circle(4.0));
  EXPECT_NEAR(profile.length_m(), 8 * pi, 1e-12);
  EXPECT_NEAR(profile.area_m2(), 16 * pi, 1e-12);
  EXPECT_TRUE(profile.corners().empty());
  for (const double degrees : {-179.0, -90.0, -30.0, 0.0, 45.0, 90.0, 179.0}) {  // clockwise from the crown
    const ProfilePoint at = profile.at(4.0 * rad_from_deg(degrees));
    EXPECT_NEAR(at.position.x(), 4 * std::sin(rad_from_deg(degrees)), 1e-12);
    EXPECT_NEAR(at.position.y(), 4 * std::cos(rad_from_deg(degrees)), 1e-12);
    EXPECT_NEAR((at.normal - at.position / 4).norm(), 0.0, 1e-12);
    EXPECT_NEAR(at.curvature_per_m, 0.25, 1e-12);
  }
}

TEST(DesignLine, RectangleStartsInTheMiddleOfItsRoof) {
  const Profile profile("rectangle", rectangle(5.0, 3.0));
  EXPECT_NEAR(profile.area_m2(), 15.0, 1e-12);
  EXPECT_NEAR(profile.length_m(), 16.0, 1e-12);
  EXPECT_LT((profile.at(0).position - Eigen::Vector2d(0, 3)).norm(), 1e-12);
  EXPECT_LT((profile.at(1.0).position - Eigen::Vector2d(1, 3)).norm(), 1e-12);  // clockwise: to the right first
  EXPECT_LT((profile.at(-1.0).position - Eigen::Vector2d(-1, 3)).norm(), 1e-12);
  EXPECT_LT((profile.at(4.0).normal - Eigen::Vector2d(1, 0)).norm(), 1e-12);
  EXPECT_LT((profile.at(-8.0).position - Eigen::Vector2d(0, 0)).norm(), 1e-12);
  ASSERT_EQ(profile.corners().size(), 4U);
  for (const auto& corner : profile.corners()) EXPECT_NEAR(corner.turn_rad, pi / 2, 1e-12);
  EXPECT_NEAR(profile.corners()[0].p_m, 2.5, 1e-12);
  EXPECT_NEAR(profile.corners()[3].p_m, -2.5, 1e-12);
}

TEST(DesignLine, DShapeAnalytic) {
  const Profile profile("D", d_shape(3.0, 2.0));
  EXPECT_NEAR(profile.area_m2(), 6.0 * 2.0 + pi * 9 / 2, 1e-12);
  EXPECT_NEAR(profile.length_m(), 6.0 + 4.0 + 3 * pi, 1e-12);
  EXPECT_LT((profile.at(0).position - Eigen::Vector2d(0, 5)).norm(), 1e-12);
  EXPECT_EQ(profile.corners().size(), 2U);  // the arch runs into the walls without a corner
  EXPECT_NEAR(profile.box().max().y(), 5.0, 1e-12);
  EXPECT_NEAR(profile.box().min().x(), -3.0, 1e-12);
}

TEST(DesignLine, HorseshoeWithAHollowFloor) {
  const Profile profile("horseshoe", horseshoe());
  const Polygon ring = profile.flattened(1e-7);
  EXPECT_NEAR(profile.area_m2(), -area_moment(ring).area_m2, 1e-5);  // clockwise rings count negative
  double around = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) around += (ring[(i + 1) % ring.size()] - ring[i]).norm();
  EXPECT_NEAR(profile.length_m(), around, 1e-5);
  EXPECT_NEAR(profile.at(profile.nearest({0, -0.5}).p_m).curvature_per_m, -1.0 / hollow_radius_m, 1e-9);
  for (const auto& point : ring) EXPECT_NEAR(profile.nearest(point).deviation_m, 0.0, 1e-12);
}

TEST(DesignLine, NeitherStartNorSenseOfRotationMatters) {
  for (const auto& segments : {d_shape(3.0, 2.0), horseshoe(), rectangle(5, 3), circle(2.5)}) {
    const Profile reference("a", segments);
    for (std::size_t first = 0; first < segments.size(); ++first) {
      auto turned = segments;
      std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(first), turned.end());
      for (const auto& ring : {turned, backwards(turned)}) {
        const Profile other("b", ring);
        ASSERT_NEAR(other.length_m(), reference.length_m(), 1e-12);
        EXPECT_NEAR(other.area_m2(), reference.area_m2(), 1e-12);
        EXPECT_EQ(other.corners().size(), reference.corners().size());
        for (double p = -0.5 * reference.length_m(); p < 0.5 * reference.length_m(); p += 0.173) {
          EXPECT_LT((other.at(p).position - reference.at(p).position).norm(), 1e-9);
          EXPECT_LT((other.at(p).normal - reference.at(p).normal).norm(), 1e-9);
        }
      }
    }
  }
}

TEST(DesignLine, StartsAtItsOwnSegmentsAgain) {
  const Profile profile("a", horseshoe());
  const Profile again("a", profile.segments());
  EXPECT_EQ(again.segments().size(), profile.segments().size());
  EXPECT_NEAR(again.area_m2(), profile.area_m2(), 1e-12);
}

TEST(DesignLine, PIsWrappedIntoHalfALength) {
  const Profile profile("rectangle", rectangle(5.0, 3.0));
  EXPECT_DOUBLE_EQ(profile.wrapped_p(8.0), -8.0);
  EXPECT_DOUBLE_EQ(profile.wrapped_p(17.0), 1.0);
  EXPECT_DOUBLE_EQ(profile.wrapped_p(-9.0), 7.0);
  EXPECT_LT((profile.at(35.0).position - profile.at(3.0).position).norm(), 1e-12);
}

TEST(DesignLine, SnapsJoinsOfAMillimetre) {
  auto segments = rectangle(5, 3);
  segments[1].start.x() += 0.0009;
  EXPECT_NEAR(Profile("a", segments).area_m2(), 15.0, 0.005);
}

TEST(DesignLine, AnOpenLineIsRefusedWithTheMend) {
  auto segments = d_shape(3, 2);
  segments.pop_back();  // the floor
  expect_mentions(message_of(segments), {"open", "close the line along the floor"});
}

TEST(DesignLine, ALineThatDoesNotJoinIsRefusedByNumberAndPlace) {
  auto segments = rectangle(5, 3);
  segments[1].start.x() += 0.25;
  segments[2].start.y() -= 0.5;
  expect_mentions(message_of(segments), {"segment 1 and segment 2", "0.25 m"});
}

TEST(DesignLine, ALineThatCrossesItselfIsRefusedByNumberAndPlace) {
  const std::vector<ProfileSegment> bow{
      {{0, 0}, {2, 2}, 0}, {{2, 2}, {2, 0}, 0}, {{2, 0}, {0, 2}, 0}, {{0, 2}, {0, 0}, 0}};
  expect_mentions(message_of(bow), {"crosses", "segment 1 meets segment 3", "(1, 1) m"});
  // An arch that sags through the floor.
  const std::vector<ProfileSegment> sagging{
      {{-3, 0}, {3, 0}, 0}, {{3, 0}, {3, 1}, 0}, {{3, 1}, {-3, 1}, -0.6}, {{-3, 1}, {-3, 0}, 0}};
  expect_mentions(message_of(sagging), {"segment 1 meets segment 3"});
}

TEST(DesignLine, ALineThatTouchesItselfOrFoldsBackIsRefused) {
  const std::vector<ProfileSegment> slit{
      {{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {2, 0}, 0}, {{2, 0}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  expect_mentions(message_of(slit), {"touches", "(2, 0) m"});
  const std::vector<ProfileSegment> spike{{{0, 0}, {4, 0}, 0}, {{4, 0}, {4, 3}, 0}, {{4, 3}, {4, 5}, 0},
                                          {{4, 5}, {4, 3}, 0}, {{4, 3}, {0, 3}, 0}, {{0, 3}, {0, 0}, 0}};
  expect_mentions(message_of(spike), {"segment 3 meets segment 4", "(4, 5) m"});
}

TEST(DesignLine, RefusesWhatHasNoInside) {
  expect_mentions(message_of(rectangle(0.2, 0.04)), {"area", "0.008", "unit"});
  expect_mentions(message_of(rectangle(6000, 3)), {"6000 m wide", "unit"});
  EXPECT_NE(message_of({}), "");
  EXPECT_NE(message_of({{{0, 0}, {1, 0}, 0}}), "");
  EXPECT_NE(message_of({{{0, 0}, {1, 0}, 0}, {{1, 0}, {0, 0}, 0}}), "");
  auto broken = rectangle(5, 3);
  broken[2].end.x() = std::nan("");
  expect_mentions(message_of(broken), {"segment 3", "not finite"});
}

TEST(DesignLine, AFlatArcIsNoWorseThanALine) {
  for (const double bulge : {1e-12, 1e-9, 1e-7, 1e-5}) {  // radii from 250 km up
    auto segments = rectangle(10, 4);
    segments[2].bulge = bulge;  // the roof
    const Profile profile("a", segments);
    const double sagitta = 5 * bulge;
    EXPECT_NEAR(profile.nearest({0.0, 5.0}).deviation_m, 1.0 - sagitta, 2e-9);
    EXPECT_NEAR(profile.nearest({3.0, 3.5}).deviation_m, -0.5 - sagitta * (1 - 0.36), 2e-9);
    EXPECT_NEAR(profile.area_m2(), 40 + 2.0 / 3.0 * 10 * sagitta, 1e-8);
  }
}

}  // namespace
}  // namespace adit
