#include "core/profiling/rings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

/// A curve of 200 m to the right at 2 %.
Alignment curve() {
  return Alignment("CL", HorizontalAlignment({{HorizontalKind::arc, "", {500, 700}, 0.4, 100, 0.005, 0.005}}, 1000.0),
                   VerticalAlignment({{1000, 50}, {1100, 52}}));
}

/// Points of a ring square to the axis: radius by the clock, centre beside the axis.
std::vector<RingPoint> ring_at(const Alignment& axis, double chainage_m, const Eigen::Vector2d& center, int n,
                               const std::function<double(double)>& radius_m, const std::string& name = "7",
                               double from_deg = 0.0, double to_deg = 360.0) {
  const PlanPoint plan = axis.horizontal().at(chainage_m);
  const double grade = axis.vertical().at(chainage_m).grade;
  const Eigen::Vector3d along = Eigen::Vector3d(plan.tangent().x(), plan.tangent().y(), grade).normalized();
  const Eigen::Vector3d right(plan.right().x(), plan.right().y(), 0.0);
  const Eigen::Vector3d up = right.cross(along);
  const Eigen::Vector3d middle = axis.to_site({chainage_m, center.x(), center.y()});
  std::vector<RingPoint> points;
  for (int i = 0; i < n; ++i) {
    const double clock = rad_from_deg(from_deg + (to_deg - from_deg) * (i + 0.3) / n);
    RingPoint point{name, std::to_string(i + 1), {}};
    point.place.position = middle + radius_m(clock) * (std::sin(clock) * right + std::cos(clock) * up);
    points.push_back(point);
  }
  return points;
}

RingsResult fitted(const std::vector<RingPoint>& points, const Alignment& axis, const RingDesign& design = {}) {
  Progress progress;
  return fit_rings(points, axis, design, progress);
}

TEST(Rings, AnExactCircleGivesItsCentreChainageAndRadius) {
  const Alignment axis = curve();
  for (const int n : {4, 8, 40}) {
    auto points = ring_at(axis, 1042.0, {0.03, -0.02}, n, [](double) { return 1.7 - 0.038; });
    for (RingPoint& point : points) point.place.target_offset_m = 0.038;
    const RingsResult result = fitted(points, axis);
    ASSERT_EQ(result.rings.size(), 1U);
    const RingResult& ring = result.rings[0];
    EXPECT_NEAR(ring.chainage_m, 1042.0, 1e-6);
    EXPECT_NEAR(ring.horizontal_deviation_m, 0.03, 1e-6);
    EXPECT_NEAR(ring.vertical_deviation_m, -0.02, 1e-6);
    EXPECT_NEAR(ring.radius_m, 1.7, 1e-9);
    EXPECT_NEAR(ring.rms_m, 0.0, 1e-9);
    EXPECT_NEAR(ring.tilt_deg, 0.0, 1e-3);
    EXPECT_EQ(std::isnan(ring.ovality_m), n < 6);
    EXPECT_FALSE(std::abs(ring.ovality_m) > 1e-5);
    EXPECT_TRUE(result.findings.empty());
  }
}

TEST(Rings, MixedTargetOffsetsDoNotMoveTheCentre) {
  const Alignment axis = curve();
  auto points = ring_at(axis, 1042.0, {0, 0}, 8, [](double) { return 1.7; });
  const Eigen::Vector3d center = axis.to_site({1042.0, 0.0, 0.0});
  for (std::size_t i = 0; i < 4; ++i) {  // half of them measured to a target
    points[i].place.target_offset_m = 0.038;
    points[i].place.position -= 0.038 * (points[i].place.position - center).normalized();
  }
  const RingsResult result = fitted(points, axis);
  EXPECT_NEAR(result.rings[0].horizontal_deviation_m, 0.0, 1e-6);
  EXPECT_NEAR(result.rings[0].radius_m, 1.7, 1e-6);
}

TEST(Rings, AnEllipseGivesItsOvalityAndWhereItPoints) {
  const Alignment axis = curve();
  const double a = 3.06, b = 2.94, turn = rad_from_deg(35.0);
  const auto radius = [&](double clock) {
    const double c = std::cos(clock - turn), s = std::sin(clock - turn);
    return a * b / std::sqrt(b * b * c * c + a * a * s * s);
  };
  const RingsResult result = fitted(ring_at(axis, 1020.0, {0, 0}, 24, radius), axis);
  EXPECT_NEAR(result.rings[0].ovality_m, 2.0 * (a - b), 1e-6);
  EXPECT_NEAR(result.rings[0].major_clock_deg, 35.0, 1e-3);
}

TEST(Rings, ErrorsStayWithinTheStatedSigmas) {
  const Alignment axis = curve();
  const Random random(11, 3);
  constexpr int trials = 400;
  int within = 0;
  for (int t = 0; t < trials; ++t) {
    auto points = ring_at(axis, 1050.0, {0, 0}, 12, [](double) { return 2.0; });
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int k = 0; k < 3; ++k)
        points[i].place.position(k) +=
            0.002 * random.normal(static_cast<std::uint64_t>(t) * 100 + 3 * i + static_cast<std::uint64_t>(k));
    const RingResult ring = fitted(points, axis).rings[0];
    within += std::abs(ring.horizontal_deviation_m) <= 2.0 * ring.sigma_center_m ? 1 : 0;
    within += std::abs(ring.vertical_deviation_m) <= 2.0 * ring.sigma_center_m ? 1 : 0;
    within += std::abs(ring.radius_m - 2.0) <= 2.0 * ring.sigma_radius_m ? 1 : 0;
  }
  EXPECT_GT(within, 3 * trials * 90 / 100);
  EXPECT_LT(within, 3 * trials * 99 / 100);
}

TEST(Rings, ADesignCentreBesideTheAxisAndRingsInOrderOfChainage) {
  const Alignment axis = curve();
  auto points = ring_at(
      axis, 1060.0, {1.5, 1.8}, 8, [](double) { return 3.0; }, "B");
  const auto more = ring_at(
      axis, 1030.0, {1.51, 1.78}, 8, [](double) { return 3.0; }, "A");
  points.insert(points.end(), more.begin(), more.end());
  const RingsResult result = fitted(points, axis, {1.5, 1.8, 3.0});
  ASSERT_EQ(result.rings.size(), 2U);
  EXPECT_EQ(result.rings[0].ring, "A");
  EXPECT_NEAR(result.rings[0].horizontal_deviation_m, 0.01, 1e-5);
  EXPECT_NEAR(result.rings[0].vertical_deviation_m, -0.02, 1e-5);
  EXPECT_NEAR(result.rings[1].horizontal_deviation_m, 0.0, 1e-5);
}

TEST(Rings, ATolerancePermitsWhatTwoSigmasMayExplain) {
  const Alignment axis = curve();
  const auto radius = [](double clock) { return 1.7 + 0.002 * std::cos(7.0 * clock); };  // some misfit: a sigma
  RingDesign design;
  design.tolerance_m = 0.05;
  const auto verdict = [&](double across_m) {
    return fitted(ring_at(axis, 1042.0, {across_m, 0.0}, 12, radius), axis, design);
  };
  EXPECT_EQ(verdict(0.049).rings[0].verdict, ToleranceVerdict::kept);
  EXPECT_TRUE(verdict(0.049).findings.empty());
  EXPECT_EQ(verdict(-0.0505).rings[0].verdict, ToleranceVerdict::undecided);
  EXPECT_EQ(verdict(0.06).rings[0].verdict, ToleranceVerdict::broken);
  EXPECT_EQ(verdict(0.06).findings.size(), 1U);
  design.tolerance_m = 0.0;
  EXPECT_EQ(verdict(0.06).rings[0].verdict, ToleranceVerdict::not_shown);
}

TEST(Rings, OfFivePointsTheOddOneIsNamed) {
  const Alignment axis = curve();
  auto points = ring_at(axis, 1042.0, {0.0, 0.0}, 5, [](double) { return 2.5; });
  const Eigen::Vector3d middle = axis.to_site({1042.0, 0.0, 0.0});
  points[3].place.position += 0.08 * (middle - points[3].place.position).normalized();
  const RingsResult result = fitted(points, axis);
  ASSERT_FALSE(result.findings.empty());
  EXPECT_EQ(result.findings[0].words.rfind("point 4 lies 80 mm off", 0), 0U) << result.findings[0].words;
  for (const double blunder_m : {0.04, 0.05, 0.1, 0.3}) {  // with noise: never a good point instead
    auto noisy = ring_at(axis, 1042.0, {0.0, 0.0}, 5, [](double) { return 3.0; });
    const Random random(3, 1);
    std::uint64_t n = 0;
    for (RingPoint& point : noisy)
      for (int k = 0; k < 3; ++k) point.place.position(k) += 0.0005 * random.normal(n++);
    noisy[1].place.position += blunder_m * (noisy[1].place.position - middle).normalized();
    const RingsResult named = fitted(noisy, axis);
    ASSERT_FALSE(named.findings.empty()) << blunder_m;
    EXPECT_EQ(named.findings[0].words.rfind("point 2 lies ", 0), 0U) << named.findings[0].words;
  }
}

TEST(Rings, WhatIsDoubtfulIsNamed) {
  const Alignment axis = curve();
  const auto round = [](double) { return 2.0; };
  const auto said = [](const RingsResult& result) {
    return result.findings.empty() ? std::string() : result.findings[0].subject + ": " + result.findings[0].words;
  };
  const RingsResult two = fitted(ring_at(axis, 1030.0, {0, 0}, 2, round), axis);
  EXPECT_TRUE(two.rings.empty());
  EXPECT_EQ(two.findings.at(0).severity, Severity::decision);
  EXPECT_NE(said(two).find("ring 7: it has 2 points"), std::string::npos);
  EXPECT_NE(said(fitted(ring_at(axis, 1030.0, {0, 0}, 3, round), axis)).find("nothing checks"), std::string::npos);
  auto blunder = ring_at(axis, 1030.0, {0, 0}, 9, round);
  blunder[4].place.position.z() += 0.05;
  EXPECT_NE(said(fitted(blunder, axis)).find("point 5 lies"), std::string::npos);
  auto two_off = ring_at(axis, 1030.0, {0, 0}, 12, [](double) { return 3.0; });
  const Eigen::Vector3d center = axis.to_site({1030.0, 0.0, 0.0});
  for (const std::size_t i : {2U, 3U}) two_off[i].place.position -= (two_off[i].place.position - center).normalized();
  const RingsResult masked = fitted(two_off, axis);
  EXPECT_EQ(masked.findings.at(0).severity, Severity::decision);
  EXPECT_NE(masked.findings.at(0).words.find("points 3 and 4 lie up to 1000 mm"), std::string::npos);
  auto both = ring_at(axis, 1030.0, {0, 0}, 8, round, "7");
  for (const RingPoint& point : ring_at(axis, 1060.0, {0, 0}, 8, round, "7")) both.push_back(point);
  EXPECT_NE(said(fitted(both, axis)).find("beside one plane"), std::string::npos);
  const RingsResult wrong_radius = fitted(ring_at(axis, 1030.0, {0, 0}, 8, round), axis, {0.0, 0.0, 20.0});
  EXPECT_EQ(wrong_radius.findings.at(0).severity, Severity::decision);
  EXPECT_NE(said(fitted(ring_at(axis, 1030.0, {0, 9}, 8, round), axis)).find("farther from its place"),
            std::string::npos);
  auto line = ring_at(axis, 1030.0, {0, 0}, 3, round);
  line[1].place.position = 0.5 * (line[0].place.position + line[2].place.position);
  EXPECT_NE(said(fitted(line, axis)).find("one line"), std::string::npos);
  auto far = ring_at(axis, 1030.0, {0, 0}, 8, round);
  for (RingPoint& point : far) point.place.position.x() += 5000.0;
  EXPECT_NE(said(fitted(far, axis)).find("no single foot"), std::string::npos);
  // A fifth of the ring: fitted, with sigmas that say how little it tells.
  auto part = ring_at(axis, 1030.0, {0, 0}, 10, round, "7", 0.0, 72.0);
  const Random random(2, 2);
  for (std::size_t i = 0; i < part.size(); ++i) part[i].place.position.z() += 0.001 * random.normal(i);
  const RingResult few = fitted(part, axis).rings.at(0);
  EXPECT_GT(few.sigma_radius_m, 0.002);
  EXPECT_TRUE(std::isnan(few.ovality_m));  // any ellipse fits an arc
  const RingsResult short_arc = fitted(ring_at(axis, 1030.0, {0, 0}, 13, round, "7", -30.0, 30.0), axis);
  EXPECT_NE(said(short_arc).find("degrees of it only"), std::string::npos);
}

}  // namespace
}  // namespace adit
