#include "core/georeference/control.h"

#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "core/foundation/random.h"

namespace adit {
namespace {

std::vector<Eigen::Vector3d> some_points(std::size_t n) {
  const Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < n; ++i) {
    points.emplace_back(random.uniform(3 * i, -20, 20), random.uniform(3 * i + 1, -4, 4),
                        random.uniform(3 * i + 2, 0, 6));
  }
  return points;
}

std::vector<Eigen::Vector3d> moved(const Pose& pose, std::vector<Eigen::Vector3d> points) {
  for (auto& p : points) p = pose * p;
  return points;
}

TEST(RigidFit, FindsThePoseAtSiteCoordinates) {
  const Pose truth = make_pose({2683026.5, 1251466.25, 412.0}, {2.6, 0.1, -0.05});
  const auto source = some_points(5);
  const auto fit = fit_rigid(source, moved(truth, source));
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(rotation_between_rad(*fit, truth), 1e-9);
  EXPECT_LT(distance_between_m(*fit, truth), 1e-8);
}

TEST(RigidFit, ThreePointsOfAPlaneNeverGiveAMirrorImage) {
  const std::vector<Eigen::Vector3d> source{{0, 0, 0}, {5, 0, 0}, {0, 3, 0}};
  const Pose truth = make_pose({1, 2, 3}, {0.4, 1.2, -2.0});
  const auto fit = fit_rigid(source, moved(truth, source));
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->linear().determinant(), 1.0, 1e-12);
  EXPECT_LT(rotation_between_rad(*fit, truth), 1e-7);
}

TEST(RigidFit, LeastSquaresSpreadsNoise) {
  const Pose truth = make_pose({10, 20, 3}, {0.4, 0, 0});
  const auto source = some_points(400);
  auto target = moved(truth, source);
  const Random random(8);
  for (std::size_t i = 0; i < target.size(); ++i) {
    target[i] += 0.01 * Eigen::Vector3d(random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
  }
  const auto fit = fit_rigid(source, target);
  ASSERT_TRUE(fit.has_value());
  EXPECT_LT(distance_between_m(*fit, truth), 0.003);  // about 0.01 / sqrt(400), with the lever of the far origin
}

TEST(RigidFit, NothingFromTooFewOrAlignedPoints) {
  EXPECT_FALSE(fit_rigid({{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {1, 0, 0}}).has_value());
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {10, 0.004, 0}, {20, 0, 0.003}};
  EXPECT_FALSE(fit_rigid(line, line).has_value());
  EXPECT_THROW(fit_rigid(some_points(4), some_points(3)), Error);
}

}  // namespace
}  // namespace adit
