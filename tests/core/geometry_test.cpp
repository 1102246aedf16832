#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/geometry/nearest_neighbours.h"
#include "core/geometry/polygon.h"
#include "core/geometry/pose.h"
#include "core/geometry/statistics.h"
#include "core/geometry/tile_source.h"

namespace adit {
namespace {

TEST(Pose, YawPitchRollThereAndBack) {
  const YawPitchRoll angles{1.2, -0.4, 0.3};
  const Pose pose = make_pose({1, 2, 3}, angles);
  const YawPitchRoll back = yaw_pitch_roll(pose);
  EXPECT_NEAR(back.yaw_rad, 1.2, 1e-12);
  EXPECT_NEAR(back.pitch_rad, -0.4, 1e-12);
  EXPECT_NEAR(back.roll_rad, 0.3, 1e-12);
  EXPECT_TRUE((rotation_from_vector(rotation_vector(pose.linear())) - pose.linear()).norm() < 1e-12);
  EXPECT_TRUE(is_rigid(pose.matrix()));
}

TEST(Polygon, AreaAndMomentOfASquareOffTheAxis) {
  const Polygon square{{1, 0}, {3, 0}, {3, 2}, {1, 2}};
  EXPECT_NEAR(area_moment(square).area_m2, 4.0, 1e-12);
  EXPECT_NEAR(area_moment(square).moment_m3, 8.0, 1e-12);
}

TEST(Polygon, DifferencesObeyTheAreaIdentity) {
  const Polygon a{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  const Polygon b{{1, 1}, {6, 1}, {6, 2}, {1, 2}};
  const double over = area_moment(difference(a, b)).area_m2;
  const double under = area_moment(difference(b, a)).area_m2;
  EXPECT_NEAR(over, 9.0, 1e-9);
  EXPECT_NEAR(under, 2.0, 1e-9);
  EXPECT_NEAR(over - under, area_moment(a).area_m2 - area_moment(b).area_m2, 1e-9);
}

TEST(Polygon, OffsetOfASquareRoundsItsCorners) {
  const Polygon square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_NEAR(area_moment(offset_ring(square, 0.5)).area_m2, 4 + 4 * 2 * 0.5 + pi * 0.25, 1e-4);
  EXPECT_NEAR(area_moment(offset_ring(square, -0.5)).area_m2, 1.0, 1e-9);
}

TEST(Polygon, FindsWhereARingCrossesItself) {
  EXPECT_EQ(self_crossings({{0, 0}, {2, 2}, {2, 0}, {0, 2}}).size(), 1U);
  EXPECT_TRUE(self_crossings({{0, 0}, {2, 0}, {2, 2}, {0, 2}}).empty());
}

TEST(Statistics, MedianQuantileAndRobustSigma) {
  EXPECT_DOUBLE_EQ(median({3, 1, 2, 4}), 2.5);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.25), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  std::vector<double> values(10001);
  const Random random(1);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i < 500 ? 1000.0 : random.normal(i);
  EXPECT_NEAR(robust_sigma(values), 1.0, 0.1);
}

PointCloud noise_cloud(std::size_t n) {
  PointCloud cloud;
  const Random random(11);
  for (std::size_t i = 0; i < n; ++i) {
    cloud.points.emplace_back(static_cast<float>(random.uniform(3 * i, 0, 10)),
                              static_cast<float>(random.uniform(3 * i + 1, 0, 10)),
                              static_cast<float>(random.uniform(3 * i + 2, 0, 1)));
    cloud.intensity.push_back(static_cast<float>(i));
  }
  return cloud;
}

TEST(NearestNeighbours, WithinReachAreThoseOfBruteForce) {
  const Random random(8);
  std::uint64_t n = 0;
  const auto place = [&](float size) {
    n += 3;
    return Eigen::Vector3f(
        size * Eigen::Vector3d(random.uniform(n), random.uniform(n + 1), random.uniform(n + 2)).cast<float>());
  };
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 2000; ++i) points.push_back(place(4.0F));
  const NearestNeighbours tree(points);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f query = place(6.0F);
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      if ((points[k] - query).squaredNorm() < (points[best] - query).squaredNorm()) best = k;
    const auto nearest = tree.nearest_within(query, 0.3);
    ASSERT_EQ(nearest.has_value(), (points[best] - query).norm() <= 0.3F);
    if (!nearest) continue;
    ++found;
    EXPECT_EQ(nearest->index, best);
    EXPECT_NEAR(nearest->squared_distance_m2, (points[best] - query).squaredNorm(), 1e-6F);
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 450);
}

TEST(Tiles, DoNotDependOnTheOrderOfThePoints) {
  PointCloud cloud = noise_cloud(5000);
  const TiledCloud a = tiled(cloud, 1000);
  std::reverse(cloud.points.begin(), cloud.points.end());
  std::reverse(cloud.intensity.begin(), cloud.intensity.end());
  const TiledCloud b = tiled(cloud, 1000);
  EXPECT_EQ(a.cloud.points, b.cloud.points);
  EXPECT_EQ(a.cloud.intensity, b.cloud.intensity);
  EXPECT_EQ(a.tile_begin.size(), 6U);
}

TEST(Tiles, APrefixIsAnEvenSubsample) {
  const CloudTiles tiles(noise_cloud(64000), 64000);
  const PointCloud prefix = tiles.read(0, 1000);
  int quadrant[4] = {};
  for (const auto& p : prefix.points) ++quadrant[(p.x() > 5) + 2 * (p.y() > 5)];
  for (const int count : quadrant) EXPECT_NEAR(count, 250, 25);  // random choice would scatter by 14
}

}  // namespace
}  // namespace adit
