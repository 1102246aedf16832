#include <gtest/gtest.h>

#include <cmath>

#include "core/profiling/overbreak.h"
#include "core/simulation/ray_cast.h"
#include "tests/core/sample_mine.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

using namespace tests;

/// The as-built outline of the simulated rock by a fine sweep along the line, to check the closed formulas with
/// polygons.
Polygon rock_polygon(const RockTunnel& rock, double chainage_m) {
  const ProfileStretch stretch(rock.profile(), 0.5);
  Polygon polygon;
  for (double q = 0.0; q < stretch.length_m(); q += 0.002) {
    const ProfilePoint at = stretch.at(q);
    polygon.emplace_back(at.position + rock.deviation(chainage_m, at.p_m) * at.normal);
  }
  return polygon;
}

TEST(Truth, SectionFormulasAgreeWithPolygons) {
  const RockTunnel rock = sample_rock();
  const LinePolygon line = line_polygon(rock.profile(), {"excavation", 0.0});
  for (const double s : {20.03, 41.5, 63.9}) {
    const TrueSection truth = true_section(rock, s);
    Polygon as_built = rock_polygon(rock, s);
    AreaMoment over = area_moment(difference(as_built, line.ring));
    AreaMoment under = area_moment(difference(line.ring, as_built));
    EXPECT_NEAR(truth.overbreak_m2, over.area_m2, 0.003);
    EXPECT_NEAR(truth.underbreak_m2, under.area_m2, 0.003);
    EXPECT_NEAR(truth.overbreak_moment_m3, over.moment_m3, 0.01);
    EXPECT_NEAR(truth.underbreak_moment_m3, under.moment_m3, 0.01);
    EXPECT_GT(truth.overbreak_m2, 1.0);
    EXPECT_GT(truth.underbreak_m2, 0.05);
  }
}

TEST(Truth, VolumeOfAConstantSliverOnACurveIsPappus) {
  RockTunnelOptions options;
  options.from_m = 1.0;
  options.face_m = 60.0;
  options.lookout_collar_m = options.lookout_toe_m = 0.3;
  options.roughness_sigma_m = options.floor_sigma_m = 0.0;
  options.floor_mean_m = options.corner_m = 0.0;
  const RockTunnel rock(sample_design(arch_profile(), 60.0), options);
  Progress progress;
  const VolumeAmounts straight_sum = true_volume(rock, 10.0, 50.0, progress);
  const TrueSection section = true_section(rock, 20.0);
  EXPECT_NEAR(straight_sum.overbreak_m3, 40.0 * (section.overbreak_m2 - section.overbreak_moment_m3 / 60.0), 1e-3);
  EXPECT_NEAR(straight_sum.design_m3, 40.0 * section.design_area_m2, 1e-3);  // symmetric about the axis
}

TEST(Scanner, PointsWithoutNoiseLieOnTheRock) {
  const RockTunnel rock = sample_rock();
  const Pose pose = station(rock.design(), 40.0, 77.0);
  ScannerOptions options;
  options.pulses = 20000;
  options.range_sigma_m = options.angle_sigma_rad = options.dropout = 0.0;
  Progress progress;
  const PointCloud cloud = scan_tunnel(rock, pose, options, {}, progress);
  EXPECT_GT(cloud.size(), 15000U);
  std::size_t on_rock = 0;
  for (const auto& p : cloud.points) {
    const auto at = rock.design().alignment().to_tunnel(pose * p.cast<double>());
    ASSERT_TRUE(at);
    const double nearness = rock.nearness(*at, {}).value_m;
    // At the steps between rounds the surface is a plane across the axis: there the value jumps through zero.
    if (std::abs(nearness) < 2e-4) ++on_rock;
  }
  EXPECT_GT(static_cast<double>(on_rock), 0.97 * static_cast<double>(cloud.size()));
}

TEST(Scanner, RigAndDuctHideWhatIsBehind) {
  const RockTunnel rock = sample_rock(150.0, true);
  const Pose pose = station(rock.design(), 55.0, 0.0);
  const RayCast rays(rock);
  std::size_t rig = 0, duct = 0, hits = 0;
  for (double a = 0.0; a < 2.0 * pi; a += 0.01)
    for (double e = -0.6; e < 1.2; e += 0.02) {
      const Eigen::Vector3d d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const auto hit = rays.first_hit(pose.translation(), d, 45.0, {});
      if (!hit) continue;
      ++hits;
      rig += hit->surface == Surface::rig;
      duct += hit->surface == Surface::duct;
    }
  EXPECT_GT(rig, hits / 400);
  EXPECT_GT(duct, hits / 400);
}

TEST(Scanner, LooksFromATunnelIntoItsBranch) {
  const SampleMine mine = sample_mine(MineKind::junction, 3, 4);
  ASSERT_EQ(mine.tunnels.size(), 2U);
  ScannerOptions options;
  options.pulses = 20000;
  options.range_sigma_m = options.angle_sigma_rad = options.dropout = 0.0;
  Progress progress;
  std::size_t in_branch = 0, all = 0, on_rock = 0;
  for (const Pose& pose : mine.stations) {
    const PointCloud cloud = scan_tunnel(mine.tunnels, pose, options, {}, progress);
    for (const auto& p : cloud.points) {
      double value = -1e9;
      bool beside = false;
      for (const RockTunnel& rock : mine.tunnels) {
        const auto at = rock.design().alignment().to_tunnel(pose * p.cast<double>());
        if (!at || at->s_m < rock.options().from_m) continue;
        value = std::max(value, rock.nearness(*at, {}).value_m);
        beside = &rock != &mine.tunnels.front() && at->s_m > 8.0;
      }
      ++all;
      if (std::abs(value) < 5e-4) ++on_rock;
      if (beside) ++in_branch;
    }
  }
  EXPECT_GT(in_branch, all / 20);
  EXPECT_GT(static_cast<double>(on_rock), 0.97 * static_cast<double>(all));
}

TEST(Scanner, SameSeedSamePoints) {
  const RockTunnel rock = sample_rock();
  const Pose pose = station(rock.design(), 40.0, 0.0);
  const PointCloud a = scan_at(rock, pose, 9, 8000);
  const PointCloud b = scan_at(rock, pose, 9, 8000);
  const PointCloud c = scan_at(rock, pose, 10, 8000);
  EXPECT_EQ(a.points, b.points);
  EXPECT_NE(a.points, c.points);
}

}  // namespace
}  // namespace adit
