#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "core/cleaning/no_returns.h"
#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/geometry/voxel_grid.h"
#include "core/surface/reconstruct.h"

namespace adit {
namespace {

/// Points on a tube of radius 3 and length 10, with a square hole of half a metre when asked for.
std::vector<Eigen::Vector3d> tube(bool hole) {
  std::vector<Eigen::Vector3d> points;
  const Random random(2);
  std::uint64_t i = 0;
  for (double y = 0.0; y <= 10.0; y += 0.15)
    for (double a = 0.0; a < 2.0 * pi; a += 0.05, ++i) {
      const double angle = a + 0.01 * random.uniform(2 * i);
      const double along = y + 0.02 * random.uniform(2 * i + 1);
      if (hole && std::abs(angle - 2.0) < 0.3 && std::abs(along - 5.0) < 0.9) continue;
      points.emplace_back(3.0 * std::cos(angle), along, 3.0 * std::sin(angle));
    }
  return points;
}

TEST(Surface, OfATubeHasItsAreaTwoEndsAndNormalsInwards) {
  Progress progress;
  const Mesh mesh = reconstruct(tube(false), {{0, 5, 0}}, {}, progress);
  const MeshSummary summary = summarise(mesh);
  EXPECT_NEAR(summary.area_m2, 2.0 * pi * 3.0 * 10.0, 3.0);
  EXPECT_EQ(summary.boundary_loops, 2U);
  EXPECT_EQ(summary.components, 1U);
  EXPECT_NEAR(summary.holes_m, 0.0, 1e-9);
  EXPECT_EQ(summary.points + summary.triangles, summary.edges);  // Euler: a tube has characteristic 0
  const MeshArrays arrays = mesh_arrays(mesh);
  for (std::size_t i = 0; i < arrays.triangles.size(); i += 97) {
    const auto& t = arrays.triangles[i];
    const Eigen::Vector3d normal =
        (arrays.points[t[1]] - arrays.points[t[0]]).cross(arrays.points[t[2]] - arrays.points[t[0]]);
    EXPECT_LT(normal.dot(Eigen::Vector3d(arrays.points[t[0]].x(), 0, arrays.points[t[0]].z())), 0.0);
  }
}

TEST(Surface, AHoleWiderThanTheLongestEdgeStaysOpenAndIsCounted) {
  Progress progress;
  const MeshSummary summary = summarise(reconstruct(tube(true), {{0, 5, 0}}, {}, progress));
  EXPECT_EQ(summary.boundary_loops, 3U);
  EXPECT_NEAR(summary.holes_m, 2.0 * (1.8 + 1.8), 1.0);
}

/// Leaves the memory in pieces of many sizes whose addresses follow no order.
void scatter_memory(std::uint64_t seed) {
  const Random random(seed);
  std::vector<std::unique_ptr<char[]>> pieces(400000);
  std::uint64_t i = 0;
  for (auto& piece : pieces) piece = std::make_unique<char[]>(16 + random.bits(i++) % 600);
  for (std::size_t n = pieces.size(); n > 1; --n) std::swap(pieces[n - 1], pieces[random.bits(i++) % n]);
  for (std::size_t n = 0; n + n / 8 < pieces.size(); ++n) pieces[n].reset();
}

TEST(Surface, DoesNotDependOnWhatTheMemoryHeld) {
  std::vector<Eigen::Vector3d> points = tube(true);
  const Random random(7);
  for (std::size_t i = 0; i < points.size(); ++i)  // rough enough that edges wait and points are taken out again
    for (int k = 0; k < 3; ++k) points[i][k] += 0.06 * random.normal(3 * i + static_cast<std::uint64_t>(k));
  Progress progress;
  const MeshArrays first = mesh_arrays(reconstruct(points, {{0, 5, 0}}, {}, progress));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    scatter_memory(seed);
    const MeshArrays again = mesh_arrays(reconstruct(points, {{0, 5, 0}}, {}, progress));
    EXPECT_EQ(again.points, first.points);
    EXPECT_EQ(again.triangles, first.triangles);
  }
}

TEST(Surface, TooFewPointsAreRefused) {
  Progress progress;
  EXPECT_THROW(reconstruct({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, progress), Error);
}

TEST(VoxelGrid, DoesNotDependOnTheOrderAndIsEven) {
  PointCloud cloud;
  const Random random(4);
  for (std::uint64_t i = 0; i < 20000; ++i)
    cloud.points.emplace_back(static_cast<float>(random.uniform(3 * i, -3, 3)),
                              static_cast<float>(random.uniform(3 * i + 1, -3, 3)), 0.05F);
  const PointCloud a = even_subsample(cloud, 0.5);
  std::reverse(cloud.points.begin(), cloud.points.end());
  EXPECT_EQ(a.points, even_subsample(cloud, 0.5).points);
  EXPECT_EQ(a.size(), 144U);
}

TEST(VoxelGrid, AStrayPointFarAwayIsRefused) {
  PointCloud cloud;
  cloud.points = {{0, 0, 0}, {1e7F, 0, 0}};
  EXPECT_THROW(even_subsample(cloud, 0.05), Error);
}

TEST(NoReturns, AShellOfPointsAtTheLargestRangeIsSeen) {
  NoReturnShell shell;
  for (int i = 0; i < 1000; ++i) shell.add({0.0F, 2.0F + 0.01F * static_cast<float>(i), 0.0F});
  EXPECT_EQ(shell.count(), 0U);  // a single farthest point is a point
  EXPECT_EQ(shell.begins_at_m(), std::numeric_limits<float>::infinity());
  for (int i = 0; i < 10; ++i) shell.add({0.0F, 32.76F, 0.0F});
  EXPECT_EQ(shell.count(), 10U);
  EXPECT_GT(32.76F, shell.begins_at_m());
  EXPECT_LT(11.99F, shell.begins_at_m());
}

TEST(NoReturns, NearSpheresAreRock) {
  NoReturnShell shell;
  for (int i = 0; i < 1000; ++i) shell.add({0.0F, i % 2 == 0 ? 5.0F : 9.0F, 0.0F});
  EXPECT_EQ(shell.count(), 0U);
}

}  // namespace
}  // namespace adit
