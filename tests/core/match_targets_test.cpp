#include "core/georeference/match_targets.h"

#include <gtest/gtest.h>

#include "core/foundation/random.h"

namespace adit {
namespace {

/// Control along both walls and the roof of 60 m of tunnel.
std::vector<ControlPoint> control_along(int points, std::uint64_t seed) {
  const Random random(seed, 1);
  std::vector<ControlPoint> control;
  for (int i = 0; i < points; ++i) {
    const auto n = static_cast<std::uint64_t>(3 * i);
    const double x[] = {-4.0, 4.0, 0.5};
    control.push_back({"P" + std::to_string(i),
                       {60.0 / points * i + random.uniform(n, -0.5, 0.5), x[i % 3] + random.uniform(n + 1, -0.3, 0.3),
                        (i % 3 == 2 ? 5.5 : 1.0) + random.uniform(n + 2, -0.8, 0.8)}});
  }
  return control;
}

const Pose truth = make_pose({22.0, -0.7, 1.6}, {2.2, 0.02, -0.01});

/// What a scan shows of some of them, with noise of a millimetre.
std::vector<UnnamedTarget> seen_of(const std::vector<ControlPoint>& control, const std::vector<std::size_t>& which,
                                   std::uint64_t seed) {
  const Random random(seed, 2);
  std::vector<UnnamedTarget> seen;
  for (const std::size_t i : which) {
    const Eigen::Vector3d noise(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
    seen.push_back({truth.inverse() * control[i].position + 0.001 * noise, 0.001, {}});
  }
  return seen;
}

TargetMatch matched(const std::vector<UnnamedTarget>& seen, const std::vector<ControlPoint>& control,
                    const std::optional<Pose>& guess = std::nullopt) {
  Progress progress;
  return match_targets(seen, control, guess, {}, progress);
}

TEST(MatchTargets, DistancesNameThem) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto control = control_along(40, seed);
    const std::vector<std::size_t> which{8, 11, 13, 15, 18, 20};
    std::vector<UnnamedTarget> seen = seen_of(control, which, seed);
    seen.push_back({{2.0, 1.0, 0.3}, 0.001, {}});  // a sphere that nobody surveyed
    const TargetMatch match = matched(seen, control);
    ASSERT_TRUE(match.local_from_scan) << seed;
    EXPECT_EQ(match.matched, which.size());
    EXPECT_FALSE(match.ambiguous);
    for (std::size_t k = 0; k < which.size(); ++k) EXPECT_EQ(match.control[k], which[k]);
    EXPECT_FALSE(match.control.back());
    EXPECT_LT(distance_between_m(*match.local_from_scan, truth), 0.003);
  }
}

TEST(MatchTargets, AMovedTargetIsLeftAside) {
  const auto control = control_along(40, 3);
  std::vector<UnnamedTarget> seen = seen_of(control, {8, 11, 13, 15, 18}, 3);
  seen[2].in_scan.x() += 0.2;
  const TargetMatch match = matched(seen, control);
  EXPECT_EQ(match.matched, 4U);
  EXPECT_FALSE(match.control[2]);
}

TEST(MatchTargets, WhatFitsTwiceIsNotMatchedUnlessAGuessTells) {
  // A square may be turned by quarters.
  std::vector<ControlPoint> control;
  for (const auto& [x, y] : {std::pair(3.0, 3.0), {-3.0, 3.0}, {-3.0, -3.0}, {3.0, -3.0}})
    control.push_back({"S" + std::to_string(control.size()), {20.0 + x, y, 1.0}});
  const std::vector<UnnamedTarget> seen = seen_of(control, {0, 1, 2, 3}, 1);
  const TargetMatch alone = matched(seen, control);
  EXPECT_TRUE(alone.ambiguous);
  EXPECT_EQ(alone.matched, 0U);
  EXPECT_FALSE(alone.local_from_scan);
  Pose guess = truth;
  guess.translation() += Eigen::Vector3d(0.4, -0.3, 0.1);
  const TargetMatch guided = matched(seen, control, guess);
  EXPECT_FALSE(guided.ambiguous);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(guided.control[k], k);
  // Nor does a code leave it open.
  std::vector<UnnamedTarget> coded = seen;
  coded[0].id = "S0";
  coded[1].id = "S1";
  EXPECT_EQ(matched(coded, control).matched, 4U);
}

TEST(MatchTargets, ControlInAMirrorDoesNotTurnTheScannerUpsideDown) {
  // Three targets and their mirror picture are the same triangle.
  auto control = control_along(9, 3);
  const std::vector<std::size_t> which{2, 4, 6};
  const auto seen = seen_of(control, which, 3);
  ASSERT_TRUE(matched(seen, control).local_from_scan);
  for (ControlPoint& point : control) std::swap(point.position.x(), point.position.y());
  const TargetMatch match = matched(seen, control);
  EXPECT_TRUE(!match.local_from_scan || match.local_from_scan->linear()(2, 2) > 0.0);
}

TEST(MatchTargets, AScannerThatWouldLieOnItsSideIsNotPlaced) {
  // Depths written for heights: any three points fit, with the scanner tilted about their plane.
  int fitted = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    auto control = control_along(40, seed);
    const auto seen = seen_of(control, {12, 13, 20}, seed);
    for (ControlPoint& point : control) point.position.z() = -point.position.z();
    EXPECT_FALSE(matched(seen, control).local_from_scan) << seed;
    // A guess as wrong as the heights lets it through: it is the tilt that was refused.
    std::vector<Eigen::Vector3d> source, target;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      source.push_back(seen[k].in_scan);
      target.push_back(control[std::vector<std::size_t>{12, 13, 20}[k]].position);
    }
    const auto pose = fit_rigid(source, target);
    ASSERT_TRUE(pose);
    fitted += pose->linear()(2, 2) > 0.0 && matched(seen, control, *pose).local_from_scan ? 1 : 0;
  }
  EXPECT_GE(fitted, 1);
}

TEST(MatchTargets, TooFewOrOfAnotherPlaceGiveNothing) {
  const auto control = control_along(40, 4);
  EXPECT_EQ(matched(seen_of(control, {8, 11}, 4), control).matched, 0U);
  EXPECT_EQ(matched({}, control).matched, 0U);
  EXPECT_EQ(matched(seen_of(control, {8, 11, 13}, 4), {}).matched, 0U);
  // Six targets of a tunnel that is not in the table: chance gives no four of them their distances.
  const TargetMatch other = matched(seen_of(control_along(40, 77), {8, 11, 13, 15, 18, 20}, 4), control);
  EXPECT_LT(other.matched, 4U);
  // A guess in another place rules out what fits.
  Pose far = truth;
  far.translation().x() += 20.0;
  EXPECT_LT(matched(seen_of(control, {8, 11, 13, 15, 18, 20}, 4), control, far).matched, 4U);
}

}  // namespace
}  // namespace adit
