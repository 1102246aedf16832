#include "core/design/point_axis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

/// Line, clothoid, arc of 200 m to the left, clothoid, line.
HorizontalAlignment design() {
  std::vector<HorizontalElement> elements;
  HorizontalElement next{HorizontalKind::line, "", {671000, 1507000}, 0.7, 40, 0, 0};
  for (const auto& [kind, length, k0, k1] : {std::tuple{HorizontalKind::line, 40.0, 0.0, 0.0},
                                             {HorizontalKind::clothoid, 50.0, 0.0, -0.005},
                                             {HorizontalKind::arc, 80.0, -0.005, -0.005},
                                             {HorizontalKind::clothoid, 50.0, -0.005, 0.0},
                                             {HorizontalKind::line, 40.0, 0.0, 0.0}}) {
    next.kind = kind;
    next.length_m = length;
    next.start_curvature_per_m = k0;
    next.end_curvature_per_m = k1;
    elements.push_back(next);
    const PlanPoint end = element_point(next, length);
    next.start = end.position;
    next.azimuth_rad = end.azimuth_rad;
  }
  return HorizontalAlignment(std::move(elements), 1000.0);
}

struct Listed {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> chainages;
};

Listed listed(const HorizontalAlignment& axis, double every_m, double noise_m = 0.0) {
  Listed list;
  const Random random(5, 1);
  const int n = static_cast<int>(std::lround((axis.to_m() - axis.from_m()) / every_m));
  for (int i = 0; i <= n; ++i) {
    const double s = std::min(axis.from_m() + i * every_m, axis.to_m());
    const auto j = static_cast<std::uint64_t>(i);
    list.chainages.push_back(s);
    list.points.push_back(axis.at(s).position +
                          noise_m * Eigen::Vector2d(random.uniform(2 * j, -1, 1), random.uniform(2 * j + 1, -1, 1)));
  }
  return list;
}

TEST(PointAxis, PointsEveryHalfMetreGiveTheCurveBack) {
  const HorizontalAlignment truth = design();
  const Listed list = listed(truth, 0.5);
  const PointAxis axis = axis_through(list.points, list.chainages, 0.0);
  EXPECT_TRUE(axis.smooth);
  EXPECT_TRUE(axis.corners.empty());
  double worst = 0.0, worst_turn = 0.0;
  for (double s = truth.from_m(); s < truth.to_m(); s += 0.13) {
    worst = std::max(worst, (axis.horizontal.at(s).position - truth.at(s).position).norm());
    worst_turn = std::max(worst_turn, (axis.horizontal.at(s).tangent() - truth.at(s).tangent()).norm());
  }
  EXPECT_LT(worst, 2e-5);
  EXPECT_LT(worst_turn, 1e-4);
  for (double s = truth.from_m(); s < truth.to_m(); s += 3.7)
    for (const double x : {-6.0, 4.0}) {
      const auto foot = axis.horizontal.foot(truth.to_plan({s, x}));
      ASSERT_TRUE(foot.has_value()) << s;
      EXPECT_NEAR(foot->chainage_m, s, 1e-3);
      EXPECT_NEAR(foot->offset_m, x, 2e-5);
    }
}

TEST(PointAxis, WithoutChainagesItCountsAlongItself) {
  const HorizontalAlignment truth = design();
  const Listed list = listed(truth, 1.0);
  const PointAxis axis = axis_through(list.points, {}, 1000.0);
  for (std::size_t i = 0; i < list.chainages.size(); ++i) EXPECT_NEAR(axis.chainages_m[i], list.chainages[i], 2e-4);
}

TEST(PointAxis, RoundedPointsAreSmoothedByTakingTangentsFromFartherAway) {
  const HorizontalAlignment truth = design();
  const Listed list = listed(truth, 0.5, 0.0005);
  const PointAxis axis = axis_through(list.points, {}, 1000.0);
  EXPECT_TRUE(axis.smooth);
  EXPECT_GT(axis.scatter_m, 0.0002);
  EXPECT_LT(axis.scatter_m, 0.001);
  double worst = 0.0;
  for (double s = truth.from_m() + 1; s < truth.to_m() - 1; s += 0.7) {
    const auto foot = axis.horizontal.foot(truth.to_plan({s, 0.0}));
    ASSERT_TRUE(foot.has_value());
    worst = std::max(worst, std::abs(foot->offset_m));
  }
  EXPECT_LT(worst, 0.003);
}

TEST(PointAxis, ACornerAmongClosePointsStaysACorner) {
  Listed list;
  for (int i = 0; i <= 40; ++i) list.points.emplace_back(0.0, 0.5 * i);
  for (int i = 1; i <= 40; ++i) list.points.emplace_back(0.5 * i * std::sin(0.6), 20 + 0.5 * i * std::cos(0.6));
  const PointAxis axis = axis_through(list.points, {}, 0.0);
  ASSERT_EQ(axis.corners, std::vector<std::size_t>{40});
  EXPECT_TRUE(axis.smooth);
  EXPECT_NEAR(axis.sharpest_bend_rad, 0.6, 1e-12);
  EXPECT_NEAR(axis.horizontal.at(19.9).azimuth_rad, 0.0, 1e-9);
  EXPECT_NEAR(axis.horizontal.at(20.1).azimuth_rad, 0.6, 1e-9);
}

TEST(PointAxis, PointsTooFarApartForTheCurveAreJoinedStraight) {
  const Listed list = listed(design(), 26.0);
  const PointAxis axis = axis_through(list.points, {}, 1000.0);
  EXPECT_FALSE(axis.smooth);
  EXPECT_GT(axis.sharpest_bend_rad, 0.05);
  EXPECT_EQ(axis.horizontal.elements().size(), list.points.size() - 1);
  const PointAxis few = axis_through({{500, 1000}, {500, 1050}, {510, 1100}, {530, 1150}}, {}, 0.0);
  EXPECT_FALSE(few.smooth);
  EXPECT_GT(few.sharpest_bend_rad, 0.18);
  const PointAxis far_apart = axis_through({{0, 0}, {100, 0}, {200, 0}}, {}, 50.0);
  EXPECT_NEAR(far_apart.chainages_m[2], 250.0, 1e-9);
  const PointAxis straight = axis_through({{0, 0}, {0, 100}}, {500, 600}, 0.0);
  EXPECT_NEAR(straight.horizontal.at(550).position.y(), 50, 1e-12);
}

std::string message_of(const std::vector<Eigen::Vector2d>& points, const std::vector<double>& chainages) {
  try {
    axis_through(points, chainages, 0.0);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PointAxis, WhatMakesNoAxisIsRefusedByPoint) {
  EXPECT_NE(message_of({{0, 0}}, {}).find("two points"), std::string::npos);
  EXPECT_NE(message_of({{0, 0}, {0, 0}}, {}).find("point 2"), std::string::npos);
  EXPECT_NE(message_of({{0, 0}, {0, 10}, {0, 5}}, {}).find("turns back at point 2"), std::string::npos);
  EXPECT_NE(message_of({{0, 0}, {0, 10}, {0, 20}}, {0, 10, 9}).find("point 3"), std::string::npos);
  EXPECT_NE(message_of({{0, 0}, {0, 10}, {0, 20}}, {0, 10, 20.1}).find("advances by 10.1 m"), std::string::npos);
}

}  // namespace
}  // namespace adit
