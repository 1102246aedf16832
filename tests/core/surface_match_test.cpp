#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/random.h"
#include "core/geometry/pose_step.h"
#include "core/registration/loops.h"
#include "core/registration/observability.h"
#include "core/registration/scale_check.h"

namespace adit {
namespace {

constexpr double cell_m = 0.2;

/// A plane square.
struct Patch {
  Eigen::Vector3d middle, normal;
  double half_m = 4.0;
};

/// Points of a patch, with noise along the normal.
void add_patch(std::vector<Eigen::Vector3f>& points, const Patch& patch, double noise_m, std::uint64_t seed) {
  const Random random(seed);
  const Eigen::Vector3d u = patch.half_m * patch.normal.unitOrthogonal();
  const Eigen::Vector3d v = patch.normal.cross(u);
  for (std::uint64_t i = 0; i < 40000; ++i)
    points.push_back((patch.middle + random.uniform(3 * i, -1, 1) * u + random.uniform(3 * i + 1, -1, 1) * v +
                      noise_m * random.normal(100000 + i) * patch.normal)
                         .cast<float>());
}

SurfaceMap map_of(const std::vector<Eigen::Vector3f>& points, bool seen_from_origin = false) {
  const std::vector<CellSums> sums = cell_sums(points, cell_m);
  const std::vector<DistributionMap> planes{DistributionMap(with_double_cells(sums), 2.0 * cell_m, {})};
  return {sums, cell_m, planes, seen_from_origin};
}

/// Where the source's scanner stood: its cells are not those of the target.
const Pose stood = make_pose({0.37, -0.21, 0.13}, {0.7, 0.02, -0.03});

std::vector<Eigen::Vector3f> seen_from(const Pose& pose, std::vector<Eigen::Vector3f> points) {
  for (auto& p : points) p = (pose.inverse() * p.cast<double>()).cast<float>();
  return points;
}

SurfaceMap surface_of(const std::vector<Patch>& patches, double noise_m, std::uint64_t seed,
                      const Pose& from = Pose::Identity()) {
  std::vector<Eigen::Vector3f> points;
  for (const Patch& patch : patches) add_patch(points, patch, noise_m, seed++);
  return map_of(seen_from(from, points));
}

const std::vector<Patch> room{{{4.1, 0.3, 0.2}, {1, 0, 0}},
                              {{0.1, 5.0, 0.3}, {0, 1, 0}},
                              {{0.2, 0.4, -3.0}, {0, 0, 1}},
                              {{0.2, -5.0, 0.4}, {0, 1, 0}}};
const std::vector<Patch> corridor{
    {{0.1, 5.0, 0.3}, {0, 1, 0}}, {{0.2, 0.4, -3.0}, {0, 0, 1}}, {{0.2, -5.0, 0.4}, {0, 1, 0}}};

/// A circular tube of 4 m radius along x.
SurfaceMap tube(double noise_m, std::uint64_t seed, const Pose& from = Pose::Identity()) {
  const Random random(seed);
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 150000; ++i) {
    const double angle = random.uniform(2 * i, -pi, pi);
    const double radius = 4.0 + noise_m * random.normal(1000000 + i);
    points.push_back(
        Eigen::Vector3d(random.uniform(2 * i + 1, -9, 9), radius * std::cos(angle), radius * std::sin(angle))
            .cast<float>());
  }
  return map_of(seen_from(from, points));
}

PairInformation judged(const SurfaceMap& target, const SurfaceMap& source) {
  Progress progress;
  return judge_observability(surface_matches(target, source, stood, progress), 0.05, tunnel_axes({1, 0, 0}), {}, {});
}

std::vector<std::string> undetermined(const PairInformation& known) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 6; ++i)
    if (known.undetermined[i]) names.emplace_back(direction_names[i]);
  return names;
}

TEST(SurfaceMatch, OneStepFindsASmallMoveOfPlanes) {
  const SurfaceMap target = surface_of(room, 0.003, 1);
  const SurfaceMap source = surface_of(room, 0.003, 50);
  Progress progress;
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(0.02, -0.03, 0.01);
  pose.linear() = rotation_from_vector({0.002, -0.001, 0.003});
  for (int i = 0; i < 4; ++i) {
    const auto matches = surface_matches(target, source, pose, progress);
    ASSERT_GT(matches.size(), 2000U);
    pose = stepped(pose, step_without(normal_equations(matches, 0.1), {}, tunnel_axes({1, 0, 0})));
  }
  EXPECT_LT(pose.translation().norm(), 0.001);
  EXPECT_LT(rotation_vector(pose.linear()).norm(), 0.0003);
}

TEST(SurfaceMatch, OfTwoFacesOfOneWallThereIsNone) {
  const SurfaceMap target = surface_of({{{4.0, 0, 0}, {1, 0, 0}}}, 0.0, 1);
  const SurfaceMap source = surface_of({{{4.0, 0, 0}, {0, 1, 0}}}, 0.0, 9);
  Progress progress;
  EXPECT_TRUE(surface_matches(target, source, Pose::Identity(), progress).empty());
}

TEST(SurfaceMatch, OfTwoFacesSeenFromTheirOwnSidesThereIsNone) {
  // A thin wall between two scanners. Where nobody knows where they stood, it is one surface.
  std::vector<Eigen::Vector3f> wall;
  add_patch(wall, {{1.5, 0.2, 0.1}, {1, 0, 0}, 1.0}, 0.001, 7);
  const Pose behind = make_pose({3.0, 0.1, 0.0}, {0.5, 0.0, 0.0});
  const auto matches = [&](const Pose& from, bool known) {
    Progress progress;
    return surface_matches(map_of(wall, known), map_of(seen_from(from, wall), known), from, progress).size();
  };
  EXPECT_GT(matches(behind, false), 50U);
  EXPECT_EQ(matches(behind, true), 0U);
  EXPECT_GT(matches(stood, true), 50U);
}

TEST(Observability, ARoomIsKnownInEveryDirection) {
  const PairInformation known = judged(surface_of(room, 0.003, 1), surface_of(room, 0.003, 50, stood));
  EXPECT_TRUE(undetermined(known).empty());
  EXPECT_LT(known.sigma.along_m, 0.001);
  EXPECT_GT(known.sigma.along_m, 1e-6);
}

TEST(Observability, ACorridorIsUnknownAlongAndOnlyAlong) {
  const PairInformation known = judged(surface_of(corridor, 0.003, 1), surface_of(corridor, 0.003, 50, stood));
  EXPECT_EQ(undetermined(known), std::vector<std::string>{"along"});
  EXPECT_LT(known.sigma.across_m, 0.001);
  EXPECT_LT(known.sigma.yaw_rad, 0.001);
  // Information: next to none along, plenty across.
  EXPECT_GT(known.information.inverse()(3, 3), 1.0);
  EXPECT_GT(known.information(4, 4), 1e6);
}

TEST(Observability, ACircularTubeIsUnknownAlongAndInRoll) {
  const PairInformation known = judged(tube(0.003, 1), tube(0.003, 50, stood));
  EXPECT_EQ(undetermined(known), (std::vector<std::string>{"along", "roll"}));
}

TEST(Observability, AWallWithoutNoiseIsNotKnownAlongItself) {
  const std::vector<Patch> wall{{{0.1, 5.0, 0.3}, {0, 1, 0}}};
  const PairInformation known = judged(surface_of(wall, 0.0, 1), surface_of(wall, 0.0, 50, stood));
  EXPECT_EQ(undetermined(known), (std::vector<std::string>{"along", "up", "pitch"}));
}

TEST(Observability, OnePlaceAloneTellsNothingOfItsOwnErrors) {
  const Random random(4);
  std::vector<SurfaceMatch> matches(300);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto number = [&](std::uint64_t k) { return random.uniform(10 * i + k, 0.1, 0.9); };
    matches[i].arm = Eigen::Vector3d(number(0), number(1), number(2));  // all in one cube of a metre
    matches[i].normal = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i % 3));
    matches[i].residual_m = 0.002 * random.normal(i);
  }
  for (const std::size_t count : {matches.size(), least_matches - 1}) {
    const PairInformation known =
        judge_observability(std::span(matches).first(count), 0.02, tunnel_axes({1, 0, 0}), {}, {});
    EXPECT_EQ(undetermined(known).size(), 6U) << count;
    EXPECT_TRUE(known.information.allFinite());
    EXPECT_GE(known.sigma.along_m, 1.0);
  }
}

TEST(Observability, WhatOnePlaceAloneHoldsIsUnknownAndNothingElse) {
  // All that faces along is one small patch: how wrong it is nothing tells. Walls, floor and roof are elsewhere too.
  std::vector<Patch> tunnel = corridor;
  tunnel.push_back({{4.6, 0.5, 0.5}, {1, 0, 0}, 0.3});
  const PairInformation known = judged(surface_of(tunnel, 0.003, 1), surface_of(tunnel, 0.003, 50, stood));
  EXPECT_EQ(undetermined(known), std::vector<std::string>{"along"});
  EXPECT_LT(known.sigma.across_m, 0.001);
  EXPECT_LT(known.sigma.roll_rad, 0.001);
}

TEST(Observability, OtherAnswersAreErrors) {
  Progress progress;
  const auto matches = surface_matches(surface_of(room, 0.003, 1), surface_of(room, 0.003, 50, stood), stood, progress);
  Vector6d other;
  other << 0.0, 0.01, 0.0, 0.04, 0.0, 0.05;
  ObservabilityLimits limits;
  limits.other_answers = {other};
  const PairInformation known = judge_observability(matches, 0.05, tunnel_axes({1, 0, 0}), limits, {});
  EXPECT_TRUE(undetermined(known).empty());
  EXPECT_NEAR(known.sigma.along_m, 0.04, 0.001);
  EXPECT_NEAR(known.sigma.up_m, 0.05, 0.001);
  EXPECT_LT(known.sigma.across_m, 0.001);
  EXPECT_NEAR(other.dot(known.information * other), 1.0, 0.01);
}

TEST(ScaleCheck, FindsHowMuchLargerAScanIs) {
  for (const double scale : {1.0, 1.0004, 1.002}) {
    std::vector<Eigen::Vector3f> points;
    std::uint64_t seed = 60;
    for (const Patch& patch : room) add_patch(points, patch, 0.003, seed++);
    points = seen_from(stood, points);
    for (auto& p : points) p *= static_cast<float>(scale);
    Progress progress;
    const SurfaceMap source = map_of(points);
    const ScaleCheck check = check_scale(surface_matches(surface_of(room, 0.003, 1), source, stood, progress), 0.05);
    EXPECT_NEAR(check.scale, 1.0 / scale, 3e-5);
    EXPECT_NEAR(check.scale, 1.0 / scale, 4.0 * check.sigma);
    EXPECT_GT(check.sigma, 1e-6);
    EXPECT_LT(check.sigma, 1e-4);
  }
  EXPECT_EQ(check_scale({}, 0.05).sigma, 0.0);
}

TEST(Observability, HeldDirectionsStayAtTheGuess) {
  const Pose guess = make_pose({1, 2, 3}, {0.3, 0.02, 0.01});
  Pose found = guess;
  found.translation() += Eigen::Vector3d(0.5, 0.1, -0.2);
  found.linear() = rotation_from_vector({0.01, 0.02, 0.03}) * guess.linear();
  HeldDirections held{};
  held[0] = held[5] = true;  // along, yaw
  const Pose put = held_at(guess, found, held, tunnel_axes({1, 0, 0}));
  EXPECT_TRUE(put.translation().isApprox(Eigen::Vector3d(1.0, 2.1, 2.8), 1e-12));
  EXPECT_TRUE(
      rotation_vector(put.linear() * guess.linear().transpose()).isApprox(Eigen::Vector3d(0.01, 0.02, 0.0), 1e-9));
}

TEST(Loops, OfFourScansInARingLeaveWhatThePairsLeave) {
  std::vector<Pose> truth;
  for (int i = 0; i < 4; ++i) truth.push_back(make_pose({5.0 * i, 2.0 * (i % 2), 0.1 * i}, {0.4 * i, 0.01, 0.0}));
  std::vector<GraphPair> pairs;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t k = (i + 1) % 4;
    pairs.push_back({k, i, truth[i].inverse() * truth[k], Matrix6d::Identity()});
  }
  auto loops = loops_of(4, pairs);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].nodes.size(), 4U);
  EXPECT_LT(closure_of(loops[0], pairs).translation().norm(), 1e-12);
  pairs[2].target_from_source.translation().z() += 0.01;
  EXPECT_NEAR(closure_of(loops[0], pairs).translation().norm(), 0.01, 1e-3);
  pairs.push_back({2, 0, truth[0].inverse() * truth[2], Matrix6d::Identity()});
  loops = loops_of(5, pairs);  // the fifth stands alone
  EXPECT_EQ(loops.size(), 2U);
  for (const PairLoop& loop : loops) EXPECT_EQ(loop.parts.size(), loop.nodes.size());
}

TEST(Loops, OfALongChainAreShort) {
  std::vector<GraphPair> pairs;
  for (std::size_t i = 0; i + 1 < 30; ++i) {
    pairs.push_back({i + 1, i, make_pose({5, 0, 0}, {}), Matrix6d::Identity()});
    if (i + 2 < 30) pairs.push_back({i + 2, i, make_pose({10, 0, 0}, {}), Matrix6d::Identity()});
  }
  const std::vector<PairLoop> loops = loops_of(30, pairs);
  EXPECT_EQ(loops.size(), pairs.size() - 29);
  for (const PairLoop& loop : loops) {
    EXPECT_EQ(loop.nodes.size(), 3U);
    EXPECT_LT(closure_of(loop, pairs).translation().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace adit
