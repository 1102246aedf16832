#include "core/registration/adjustment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/foundation/random.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

using namespace tests;

std::vector<Pose> stations() {
  std::vector<Pose> poses;
  for (int i = 0; i < 4; ++i) poses.push_back(make_pose({11.0 * i, 0.8 * i, 0.1 * i}, {0.3 * i, 0.01, -0.02}));
  return poses;
}

/// Four stations, all pairs of neighbours and of next neighbours, nine control points along them, noise of 1 mm.
PoseGraph survey() {
  const std::vector<Pose> truth = stations();
  const Random random(11);
  std::uint64_t n = 0;
  const auto noise = [&]() -> Eigen::Vector3d {
    n += 3;
    return 0.001 * Eigen::Vector3d(random.normal(n), random.normal(n + 1), random.normal(n + 2));
  };
  PoseGraph graph;
  for (const Pose& pose : truth) graph.local_from_scan.push_back(off(pose, {0.3, -0.2, 0.1}, 1.0));
  Matrix6d information = 1e6 * Matrix6d::Identity();
  information.topLeftCorner<3, 3>() *= 25.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t j = i + 1; j < truth.size() && j <= i + 2; ++j) {
      Pose measured = truth[i].inverse() * truth[j];
      measured.translation() += noise();
      graph.pairs.push_back({j, i, measured, information});
    }
  for (int k = 0; k < 9; ++k) {
    const Eigen::Vector3d point(4.0 * k, k % 2 == 0 ? 4.0 : -4.0, k % 3 == 0 ? 3.0 : 0.2);
    for (std::size_t i = 0; i < truth.size(); ++i)
      if ((truth[i].translation() - point).norm() < 14.0)
        graph.control.push_back({i, "T" + std::to_string(k), truth[i].inverse() * point + noise(), point});
  }
  return graph;
}

void expect_true_poses(const Adjustment& adjustment) {
  const std::vector<Pose> truth = stations();
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(distance_between_m(adjustment.solved.local_from_scan[i], truth[i]), 0.003);
}

/// The one contradiction, which must have been settled.
const Suspect& settled(const Adjustment& adjustment) {
  static const Suspect none;
  EXPECT_EQ(adjustment.contradictions.size(), 1U);
  if (adjustment.contradictions.size() != 1) return none;
  EXPECT_TRUE(adjustment.contradictions.front().left_out);
  return adjustment.contradictions.front().suspects.front();
}

TEST(Adjustment, LeavesNothingOutOfAGoodSurvey) {
  Progress progress;
  const Adjustment adjustment = adjusted(survey(), progress);
  EXPECT_TRUE(adjustment.contradictions.empty());
  expect_true_poses(adjustment);
}

TEST(Adjustment, FindsAWrongPair) {
  PoseGraph graph = survey();
  graph.pairs[2].target_from_source = off(graph.pairs[2].target_from_source, {0.5, 0.2, 0.0}, 1.0);
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  EXPECT_EQ(settled(adjustment).kind, Suspect::Kind::pair);
  EXPECT_FALSE(adjustment.pair_used[2]);
  expect_true_poses(adjustment);
}

TEST(Adjustment, FindsAWrongControlPointAndKeepsThePairs) {
  PoseGraph graph = survey();
  for (GraphControl& control : graph.control)
    if (control.id == "T4") control.in_local.x() += 0.10;
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  EXPECT_EQ(settled(adjustment).kind, Suspect::Kind::point);
  for (std::size_t k = 0; k < graph.control.size(); ++k)
    EXPECT_EQ(adjustment.control_used[k], graph.control[k].id != "T4");
  EXPECT_EQ(std::count(adjustment.pair_used.begin(), adjustment.pair_used.end(), false), 0);
  expect_true_poses(adjustment);
}

TEST(Adjustment, FindsAWrongTarget) {
  PoseGraph graph = survey();
  graph.control[5].in_scan.z() += 0.05;
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  EXPECT_EQ(settled(adjustment).kind, Suspect::Kind::observation);
  EXPECT_FALSE(adjustment.control_used[5]);
  expect_true_poses(adjustment);
}

TEST(Adjustment, DoesNotChooseWhereNothingTells) {
  PoseGraph graph = survey();
  graph.local_from_scan.resize(3);  // a triangle without control: any of its sides may be wrong
  graph.control.clear();
  graph.datum = 0;
  std::erase_if(graph.pairs, [](const GraphPair& pair) { return std::max(pair.source, pair.target) > 2; });
  ASSERT_EQ(graph.pairs.size(), 3U);
  graph.pairs[1].target_from_source.translation().y() += 0.20;
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  ASSERT_EQ(adjustment.contradictions.size(), 1U);
  EXPECT_FALSE(adjustment.contradictions.front().left_out);
  EXPECT_EQ(adjustment.contradictions.front().suspects.size(), 3U);
  EXPECT_EQ(std::count(adjustment.pair_used.begin(), adjustment.pair_used.end(), true), 3);
}

TEST(Adjustment, NeverLeavesTooLittleControl) {
  PoseGraph graph = survey();
  std::erase_if(graph.control, [](const GraphControl& c) { return c.id != "T2" && c.id != "T3" && c.id != "T4"; });
  for (GraphControl& control : graph.control)
    if (control.id == "T3") control.in_local.z() += 0.15;
  Progress progress;
  const Adjustment adjustment = adjusted(graph, progress);
  ASSERT_FALSE(adjustment.contradictions.empty());
  EXPECT_FALSE(adjustment.contradictions.back().left_out);
  std::size_t used = 0;
  for (const bool one : adjustment.control_used) used += one ? 1 : 0;
  EXPECT_EQ(used, graph.control.size());
}

}  // namespace
}  // namespace adit
