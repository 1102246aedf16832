#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/registration/icp.h"
#include "core/registration/icp_selection.h"

namespace adit {
namespace {

/// A floor and two walls with waves, 8 m wide, without noise; the seed chooses the points.
Eigen::Vector3d on_walls(double u, double v, int wall) {
  const double wave = 0.2 * std::sin(1.3 * u) * std::cos(0.9 * v);
  if (wall == 0) return {u, v, wave - 2.0};
  if (wall == 1) return {u, 4.0 + wave, v};
  return {4.0 + wave, u, v};
}
std::vector<Eigen::Vector3f> walls(std::uint64_t seed, std::uint64_t count) {
  const Random random(seed);
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < count; ++i)
    points.push_back(on_walls(random.uniform(2 * i, -4, 4), random.uniform(2 * i + 1, -4, 4), static_cast<int>(i % 3))
                         .cast<float>());
  return points;
}

IcpCloud cloud_of(const std::vector<Eigen::Vector3f>& points) {
  const DistributionMap planes(cell_sums(points, 0.4), 0.4, {});
  return icp_cloud(SurfaceMap(cell_sums(points, 0.01), 0.01, std::span(&planes, 1)));
}

IcpCloud seen_from(const Pose& pose, IcpCloud cloud) {
  const Pose back = pose.inverse();
  for (auto& p : cloud.points) p = (back * p.cast<double>()).cast<float>();
  for (auto& n : cloud.normals) n = (back.linear() * n.cast<double>()).cast<float>();
  return cloud;
}

/// Keeps everything: each test adds what it is about.
IcpOptions plain() {
  IcpOptions options;
  options.boundary_rejected = false;
  options.most_normals_deg = 90.0;
  return options;
}

const Pose off = make_pose({0.05, -0.04, 0.03}, {0.01, 0.005, -0.008});

/// A flat square of 2 m at z = height, points every 5 cm.
IcpCloud square(float height) {
  IcpCloud cloud;
  for (int i = -20; i <= 20; ++i)
    for (int k = -20; k <= 20; ++k) {
      cloud.points.emplace_back(0.05F * static_cast<float>(i), 0.05F * static_cast<float>(k), height);
      cloud.normals.emplace_back(0.0F, 0.0F, i % 2 == 0 ? 1.0F : -1.0F);
    }
  return cloud;
}

TEST(Icp, ClosedFormFindsTheTurnAndShiftOfPointsThatBelongTogether) {
  const auto points = walls(1, 300);
  const Pose truth = make_pose({0.7, -1.1, 0.4}, {1.2, -0.4, 0.3});
  const Eigen::Vector3d origin(0.3, 0.2, -0.1);
  std::vector<IcpMatch> matches(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    matches[i].place = points[i].cast<double>();
    matches[i].target = truth * matches[i].place;
    matches[i].weight = 1.0 + static_cast<double>(i % 4);
  }
  const Vector6d step = icp_step(matches, origin, IcpMetric::point_to_point);
  const Eigen::Matrix3d turn = rotation_from_vector(step.head<3>());
  EXPECT_LT((turn - truth.linear()).norm(), 1e-12);
  for (const IcpMatch& match : matches)
    EXPECT_LT((origin + step.tail<3>() + turn * (match.place - origin) - match.target).norm(), 1e-12);
}

TEST(Icp, EveryMetricBringsTheSamePointsHome) {
  const IcpCloud target = cloud_of(walls(2, 6000));
  const IcpCloud source = seen_from(off, target);
  for (const IcpMetric metric : {IcpMetric::point_to_point, IcpMetric::point_to_plane, IcpMetric::plane_to_plane}) {
    IcpOptions options = plain();
    options.metric = metric;
    options.most_iterations = 100;
    Progress progress;
    const IcpResult result = icp_align(IcpTarget(target, options), source, Pose::Identity(), options, progress);
    EXPECT_LT(distance_between_m(result.target_from_source, off), 1e-4) << static_cast<int>(metric);
    EXPECT_LT(rotation_between_rad(result.target_from_source, off), 1e-4);
    EXPECT_GT(result.matches, 5000U);
  }
}

TEST(Icp, EveryChoiceOfEveryStageComesNearOnOtherPointsOfTheSameWalls) {
  const IcpCloud target = cloud_of(walls(3, 30000));
  const IcpCloud source = seen_from(off, cloud_of(walls(4, 30000)));
  const auto error_m = [&](const auto& change) {
    IcpOptions options = plain();
    change(options);
    Progress progress;
    const IcpResult result = icp_align(IcpTarget(target, options), source, Pose::Identity(), options, progress);
    return distance_between_m(result.target_from_source, off);
  };
  EXPECT_LT(error_m([](IcpOptions&) {}), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.selection = IcpSelection::uniform; }), 0.004);
  EXPECT_LT(error_m([](IcpOptions& o) { o.selection = IcpSelection::random; }), 0.004);
  EXPECT_LT(error_m([](IcpOptions& o) { o.selection = IcpSelection::normal_space; }), 0.004);
  EXPECT_LT(error_m([](IcpOptions& o) { o.matching = IcpMatching::normal_shooting; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.matching = IcpMatching::projection; }), 0.004);
  EXPECT_LT(error_m([](IcpOptions& o) { o.weights = IcpWeights::distance; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.weights = IcpWeights::normals; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.weights = IcpWeights::range; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.reach_falls = true; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.boundary_rejected = true; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.most_normals_deg = 30.0; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.best_share = 0.7; }), 0.002);
  EXPECT_LT(error_m([](IcpOptions& o) { o.metric = IcpMetric::point_to_plane; }), 0.002);
  // Points that do not belong together pull along the walls: the reason why it is not the default.
  EXPECT_LT(error_m([](IcpOptions& o) { o.metric = IcpMetric::point_to_point; }), 0.03);
}

TEST(IcpSelection, TakesWhatIsAskedFor) {
  const IcpCloud cloud = cloud_of(walls(5, 9000));
  IcpOptions options;
  options.samples = 500;
  EXPECT_EQ(selected_points(cloud, options, 0).size(), cloud.points.size());
  for (const IcpSelection selection : {IcpSelection::uniform, IcpSelection::random, IcpSelection::normal_space}) {
    options.selection = selection;
    const auto first = selected_points(cloud, options, 0);
    EXPECT_EQ(first.size(), 500U);
    EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
    EXPECT_EQ(std::adjacent_find(first.begin(), first.end()), first.end()) << "a point taken twice";
    EXPECT_LT(first.back(), cloud.points.size());
    EXPECT_EQ(first, selected_points(cloud, options, 0));
    if (selection != IcpSelection::uniform) {
      EXPECT_NE(first, selected_points(cloud, options, 1));
      IcpOptions other = options;
      other.seed = 2;
      EXPECT_NE(first, selected_points(cloud, other, 0));
    }
  }
}

TEST(IcpSelection, NormalSpaceKeepsTheFewThatFaceAnotherWay) {
  IcpCloud cloud = square(0.0F);
  const std::size_t floor = cloud.points.size();
  for (int i = 0; i < 30; ++i) {
    cloud.points.emplace_back(1.0F, 0.01F * static_cast<float>(i), 0.5F);
    cloud.normals.emplace_back(1.0F, 0.0F, 0.0F);
  }
  IcpOptions options;
  options.selection = IcpSelection::normal_space;
  options.samples = 100;
  const auto chosen = selected_points(cloud, options, 0);
  EXPECT_EQ(std::count_if(chosen.begin(), chosen.end(), [&](std::size_t i) { return i >= floor; }), 30);
  EXPECT_EQ(chosen.size(), 100U);
}

TEST(IcpMatching, FindsThePointEachRuleMeans) {
  const IcpCloud cloud = square(1.0F);
  const auto matched = [&](IcpMatching matching, const Eigen::Vector3d& place, const Eigen::Vector3d& normal) {
    IcpOptions options = plain();
    options.matching = matching;
    return IcpTarget(cloud, options).match(place, normal, 0.6);
  };
  const Eigen::Vector3d slanted = Eigen::Vector3d(0.3, 0.0, 1.0).normalized();
  const auto nearest = matched(IcpMatching::nearest, {0.012, -0.021, 0.7}, slanted);
  ASSERT_TRUE(nearest);
  EXPECT_LT((nearest->place - Eigen::Vector3d(0.0, 0.0, 1.0)).norm(), 1e-6);
  const auto shot = matched(IcpMatching::normal_shooting, {0.012, -0.021, 0.7}, slanted);
  ASSERT_TRUE(shot);
  EXPECT_LT((shot->place - Eigen::Vector3d(0.012 + 0.09, -0.021, 1.0)).norm(), 1e-6);
  // The scanner at the origin sees (0.35, 0, 0.7) at (0.5, 0, 1).
  const auto seen = matched(IcpMatching::projection, {0.351, 0.001, 0.7}, slanted);
  ASSERT_TRUE(seen);
  EXPECT_LT((seen->place - Eigen::Vector3d(0.5, 0.0, 1.0)).norm(), 1e-6);
  for (const IcpMatching matching : {IcpMatching::nearest, IcpMatching::normal_shooting, IcpMatching::projection})
    EXPECT_FALSE(matched(matching, {0.0, 0.0, 0.3}, Eigen::Vector3d::UnitZ())) << "beyond the reach";
}

TEST(IcpMatching, TheRimIsTheRim) {
  const IcpCloud cloud = square(0.0F);
  const auto boundary = boundary_points(cloud, NearestNeighbours(cloud.points));
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const float inside = 1.0F - cloud.points[i].head<2>().cwiseAbs().maxCoeff();
    if (inside < 0.01F || inside > 0.12F) {
      EXPECT_EQ(boundary[i], inside < 0.01F ? 1 : 0) << cloud.points[i].transpose();
    }
  }
}

TEST(Icp, BoundaryPointsDragAndRejectingThemDoesNot) {
  // The paper's figure 4: the source reaches beyond the target; points out there drag it inwards.
  const IcpCloud target = square(0.0F);
  IcpCloud source = square(0.0F);
  for (auto& p : source.points) p += Eigen::Vector3f(0.4F, 0.0F, 0.02F);
  const auto moved_along_m = [&](bool rejected) {
    IcpOptions options = plain();
    options.metric = IcpMetric::point_to_point;
    options.boundary_rejected = rejected;
    options.reach_m = 1.0;
    options.most_iterations = 1;
    Progress progress;
    return std::abs(icp_align(IcpTarget(target, options), source, Pose::Identity(), options, progress)
                        .target_from_source.translation()
                        .x());
  };
  EXPECT_GT(moved_along_m(false), 0.03);
  EXPECT_LT(moved_along_m(true), 0.003);
}

TEST(Icp, StagesThatNeedNormalsSaySo) {
  const IcpCloud bare{walls(6, 100), {}};
  IcpOptions options = plain();
  EXPECT_THROW(IcpTarget(bare, options), Error);  // plane to plane
  options.metric = IcpMetric::point_to_point;
  EXPECT_NO_THROW(IcpTarget(bare, options));
  options.boundary_rejected = true;
  EXPECT_THROW(IcpTarget(bare, options), Error);
  EXPECT_THROW(IcpTarget(IcpCloud{}, plain()), Error);
}

TEST(Icp, NothingWithinReachLeavesTheStart) {
  const IcpCloud target = cloud_of(walls(7, 3000));
  const Pose far = make_pose({100.0, 0.0, 0.0}, {});
  Progress progress;
  const IcpResult result = icp_align(IcpTarget(target, plain()), target, far, plain(), progress);
  EXPECT_EQ(result.matches, 0U);
  EXPECT_LT(distance_between_m(result.target_from_source, far), 1e-12);
}

TEST(Icp, GivesTheSameBytesOnAnyNumberOfThreads) {
  const IcpCloud target = cloud_of(walls(8, 9000));
  const IcpCloud source = seen_from(off, cloud_of(walls(9, 9000)));
  IcpOptions options;
  options.selection = IcpSelection::random;
  std::vector<Eigen::Matrix4d> poses;
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Progress progress;
    poses.push_back(
        icp_align(IcpTarget(target, options), source, Pose::Identity(), options, progress).target_from_source.matrix());
  }
  EXPECT_TRUE(poses[0] == poses[1] && poses[0] == poses[2]);
}

}  // namespace
}  // namespace adit
