// What is drawn of a registration: sections through overlaps, distributions from above.

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/registration/overlap_section.h"
#include "core/registration/probability_image.h"

namespace adit {
namespace {

/// A tube of 3 m radius along x, 20 m long, in the frame of a scan that stands in it.
CloudTiles tube_from(const Pose& local_from_scan, std::uint64_t seed) {
  const Random random(seed);
  PointCloud cloud;
  for (std::uint64_t i = 0; i < 60000; ++i) {
    const double angle = random.uniform(2 * i, 0.0, 2.0 * pi);
    const Eigen::Vector3d local(random.uniform(2 * i + 1, -10.0, 10.0), 3.0 * std::cos(angle), 3.0 * std::sin(angle));
    cloud.points.push_back((local_from_scan.inverse() * local).cast<float>());
  }
  return CloudTiles(cloud, 4096);
}

TEST(OverlapSection, CutsBothScansHalfWayAcrossTheLineBetweenThem) {
  const Pose first = make_pose({-3.0, 0.2, 0.0}, {0.7, 0.05, -0.02});
  const Pose second = make_pose({4.0, 0.2, 0.5}, {-1.9, 0.0, 0.03});
  const Progress progress;
  const OverlapSection section =
      overlap_section(tube_from(first, 1), first, tube_from(second, 2), second, 200, progress);
  EXPECT_LT((section.centre - Eigen::Vector3d(0.5, 0.2, 0.25)).norm(), 1e-12);
  EXPECT_LT((section.right - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-12) << "looking along +x";
  for (const auto* points : {&section.target, &section.source}) {
    EXPECT_GT(points->size(), 50U);
    EXPECT_LE(points->size(), 200U);
    for (const Eigen::Vector2f& p : *points)
      EXPECT_NEAR(std::hypot(p.x() - 0.2, p.y() + 0.25), 3.0, 1e-5);  // about the axis of the tube
  }
}

TEST(OverlapSection, StationsAtOnePlaceAreCutAnyWay) {
  const Pose pose = make_pose({1.0, 2.0, 0.0}, {});
  const Progress progress;
  const OverlapSection section = overlap_section(tube_from(pose, 1), pose, tube_from(pose, 2), pose, 100, progress);
  EXPECT_NEAR(section.right.norm(), 1.0, 1e-12);
  EXPECT_NEAR(section.right.z(), 0.0, 1e-12);
}

DistributionMap floor_and_wall() {
  const Random random(3);
  std::vector<Eigen::Vector3f> points;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const double u = random.uniform(2 * i, -4.0, 4.0);
    const double v = random.uniform(2 * i + 1, 0.0, 3.0);
    points.push_back(i % 2 == 0 ? Eigen::Vector3f(Eigen::Vector3d(u, v, 0.0).cast<float>())
                                : Eigen::Vector3f(Eigen::Vector3d(u, 3.02, v).cast<float>()));
  }
  return {cell_sums(points, 1.0), 1.0, {}};
}

double all_of(const ProbabilityImage& image) {
  double sum = 0.0;
  for (const float density : image.density_per_m2) sum += static_cast<double>(density);
  return sum * image.pixel_m * image.pixel_m;
}

TEST(ProbabilityImage, HoldsAllCellsAndIsDensestAtWalls) {
  const ProbabilityImage image = probability_from_above(floor_and_wall(), Pose::Identity(), 0.05);
  EXPECT_NEAR(all_of(image), 1.0, 0.01);
  const auto density = [&](double x, double y) {
    return image.at(static_cast<int>((x - image.corner.x()) / image.pixel_m),
                    static_cast<int>((y - image.corner.y()) / image.pixel_m));
  };
  EXPECT_GT(density(0.3, 3.02), 5.0F * density(0.3, 1.5)) << "a wall stands on edge";
  EXPECT_GT(density(0.3, 1.5), 0.01F);
}

TEST(ProbabilityImage, TurnsWithTheScan) {
  const ProbabilityImage image =
      probability_from_above(floor_and_wall(), make_pose({100.0, 50.0, 7.0}, {0.5 * pi, 0.0, 0.0}), 0.05);
  EXPECT_NEAR(all_of(image), 1.0, 0.01);
  EXPECT_NEAR(image.corner.x() + 0.5 * image.width * image.pixel_m, 100.0 - 1.5, 0.6);
  EXPECT_NEAR(image.corner.y() + 0.5 * image.height * image.pixel_m, 50.0, 0.6);
}

TEST(ProbabilityImage, LargeScansGetLargerPixelsAndEmptyOnesAnError) {
  const ProbabilityImage image = probability_from_above(floor_and_wall(), Pose::Identity(), 0.05, 1000);
  EXPECT_LT(image.density_per_m2.size(), 1300U);
  EXPECT_GT(image.pixel_m, 0.05);
  EXPECT_THROW(probability_from_above(DistributionMap({}, 1.0, {}), Pose::Identity(), 0.05), Error);
}

}  // namespace
}  // namespace adit
