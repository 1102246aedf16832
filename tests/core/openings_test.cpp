#include "core/profiling/openings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/profiling/profiling.h"
#include "tests/core/sample_map.h"
#include "tests/core/sample_mine.h"

namespace adit {
namespace {

constexpr double half_width_m = 1.6, height_m = 1.8, middle_m = 42.05;  // in the middle of a slice and of a round

Profile door() {
  return {"door",
          {{{-half_width_m, 0.05}, {-half_width_m, height_m}, 0.0},
           {{-half_width_m, height_m}, {half_width_m, height_m}, 0.0},
           {{half_width_m, height_m}, {half_width_m, 0.05}, 0.0},
           {{half_width_m, 0.05}, {-half_width_m, 0.05}, 0.0}}};
}

/// A tunnel with a passage of smooth rock to the right at middle_m that ends `depth_m` behind the wall.
std::vector<RockTunnel> tunnel_with_passage(double depth_m) {
  RockTunnel main = tests::sample_rock(0.0);
  const Alignment& axis = main.design().alignment();
  const Eigen::Vector2d ahead = axis.horizontal().at(middle_m).tangent();
  const double azimuth = std::atan2(ahead.x(), ahead.y()) + pi / 2.0;
  RockTunnelOptions smooth;
  smooth.from_m = 0.5;
  smooth.face_m = 4.0 + depth_m;
  smooth.clutter = false;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 1e-4;
  smooth.lookout_collar_m = smooth.lookout_toe_m = smooth.floor_mean_m = smooth.corner_m = 0.0;
  RockTunnel side(DesignTunnel(tests::mine_axis(axis.to_site({middle_m, 0.0, 0.0}), azimuth, 6.0 + depth_m, 0.0, 0.0),
                               {{0.0, door()}}, {{"excavation", 0.0}}),
                  smooth);
  std::vector<RockTunnel> tunnels;
  tunnels.push_back(std::move(main));
  tunnels.push_back(std::move(side));
  return tunnels;
}

std::vector<PlacedTiles> scans_of(const std::vector<RockTunnel>& tunnels) {
  Progress progress;
  std::vector<PlacedTiles> scans;
  for (const double station_m : {36.0, 42.0, 48.0}) {
    const Pose pose = tests::station(tunnels.front().design(), station_m, 40.0);
    ScannerOptions options;
    options.pulses = 700000;
    PointCloud cloud = scan_tunnel(tunnels, pose, options, {}, progress);
    scans.push_back({"S", std::make_shared<CloudTiles>(std::move(cloud)), pose});
  }
  return scans;
}

TEST(Openings, ACrossCutIsMarkedOpenAndNeverClosed) {
  const auto tunnels = tunnel_with_passage(12.0);
  const DesignTunnel& design = tunnels.front().design();
  Progress progress;
  const MapResult mapped = map_deviations(scans_of(tunnels), design, 36.0, 48.0, {}, progress);
  ASSERT_FALSE(mapped.findings.empty());
  EXPECT_NE(mapped.findings.back().words.find("an opening of"), std::string::npos);

  const Section through = cut_section(mapped.map, design, middle_m, {});
  ASSERT_EQ(through.openings.size(), 1U);
  // From the crown down the right: half of the arch, then the wall; the door stands in its lower 1.8 m.
  const double wall_end_p = 2.0 * pi + 2.0;
  EXPECT_NEAR(through.openings[0].p_from_m, wall_end_p - height_m, 0.25);
  EXPECT_NEAR(through.openings[0].p_to_m, wall_end_p - 0.05, 0.25);
  const Section beside = cut_section(mapped.map, design, 38.0, {});
  EXPECT_TRUE(beside.openings.empty());
  // Open to the line: what lies behind it is neither overbreak nor excavated.
  const TrueSection truth = true_section(tunnels.front(), middle_m);
  const double behind_line_m2 = 1.75 * 0.22;  // the round's look-out there
  EXPECT_NEAR(through.lines[0].area_m2, truth.area_m2 - behind_line_m2, 0.1);
  EXPECT_LT(through.lines[0].max_overbreak_m, 1.0);

  const Volume volume = compute_volume(mapped.map, design, {"excavation", 0.0}, 36.0, 48.0, 1.0, {}, {}, progress);
  EXPECT_NEAR(volume.opening_m2, 2.0 * half_width_m * height_m, 1.0);
  EXPECT_GT(volume.coverage, 0.95);
}

TEST(Openings, ANicheWithinReachIsMeasured) {
  const auto tunnels = tunnel_with_passage(1.2);
  const DesignTunnel& design = tunnels.front().design();
  Progress progress;
  const MapResult mapped = map_deviations(scans_of(tunnels), design, 36.0, 48.0, {}, progress);
  EXPECT_TRUE(cut_section(mapped.map, design, middle_m, {}).openings.empty());
  const Volume volume = compute_volume(mapped.map, design, {"excavation", 0.0}, 36.0, 48.0, 1.0, {}, {}, progress);
  const VolumeAmounts plain = true_volume(tunnels.front(), 36.0, 48.0, progress);
  EXPECT_EQ(volume.opening_m2, 0.0);
  // The niche holds 3.2 x 1.75 x 1.2 m less the overbreak that the wall has there anyway, between 0.05 and 0.5 m.
  EXPECT_GT(volume.slices.overbreak_m3, plain.overbreak_m3 + 2.0 * half_width_m * 1.75 * (1.2 - 0.5));
  EXPECT_LT(volume.slices.overbreak_m3, plain.overbreak_m3 + 2.0 * half_width_m * 1.75 * (1.2 - 0.05));
}

TEST(Openings, SmallPatchesAreNotSeenRatherThanOpen) {
  const DesignTunnel design = tests::sample_design(tests::circle_profile());
  DeviationMap map = tests::map_of(design, [](double, const ProfilePoint&) { return 0.1; });
  for (std::size_t r = 10; r < 14; ++r)
    for (std::size_t c = 40; c < 45; ++c) map.cell(r, c) = {.kind = CellKind::opening};  // 0.2 m2
  for (std::size_t r = 30; r < 50; ++r)
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}, map.columns - 2, map.columns - 1})
      map.cell(r, c) = {.kind = CellKind::opening};  // 0.4 x 2 m, over the left end of the line
  const std::vector<ProfileStretch> stretches{ProfileStretch(design.profile_at(24))};
  const auto openings = find_openings(map, stretches, std::vector<std::size_t>(map.rows, 0));
  ASSERT_EQ(openings.size(), 1U);
  EXPECT_NEAR(openings[0].area_m2, 0.67, 0.01);  // the last column of the line is narrower
  EXPECT_NEAR(openings[0].from_m, 23.0, 1e-6);
  EXPECT_NEAR(openings[0].to_m, 25.0, 1e-6);
  EXPECT_NEAR(std::abs(openings[0].clock_deg), 180.0, 2.0);
  EXPECT_EQ(map.cell(12, 42).kind, CellKind::unseen);
}

}  // namespace
}  // namespace adit
