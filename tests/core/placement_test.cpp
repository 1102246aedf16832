#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "core/registration/pair_search.h"
#include "core/registration/placement.h"
#include "tests/core/sample_mine.h"

namespace adit {
namespace {

using namespace tests;

constexpr std::uint64_t pulses = 100000;

PreparedScan prepared_at(const SampleMine& mine, std::size_t station, std::uint64_t seed) {
  ScannerOptions scanner;
  scanner.seed = seed;
  scanner.pulses = pulses;
  Progress progress;
  return prepare_scan("S" + std::to_string(station),
                      CloudTiles(scan_tunnel(mine.tunnels, mine.stations[station], scanner, {}, progress)), 0.1, 0.6,
                      45.0, progress);
}

std::vector<PreparedScan> all_prepared(const SampleMine& mine) {
  std::vector<PreparedScan> scans;
  for (std::size_t i = 0; i < mine.stations.size(); ++i) scans.push_back(prepared_at(mine, i, 10 * i + 1));
  return scans;
}

RockTunnelOptions smooth_lining() {
  RockTunnelOptions smooth;
  smooth.lookout_collar_m = smooth.lookout_toe_m = 0.1;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 0.0;
  smooth.clutter = false;
  return smooth;
}

TEST(PlacementSlow, PlacesTiltedScansOfAJunctionWithoutAnyGuess) {
  const SampleMine mine = sample_mine(MineKind::junction, 2, 5);
  const std::vector<PreparedScan> scans = all_prepared(mine);
  Progress progress;
  const auto places = place_scans(scans, std::vector<std::optional<Pose>>(scans.size()), {}, progress);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    ASSERT_TRUE(places[i].local_from_scan) << i << ": " << places[i].why_not;
    const Pose right = mine.stations[0].inverse() * mine.stations[i];
    EXPECT_LT(distance_between_m(*places[i].local_from_scan, right), 0.02);
    EXPECT_LT(deg_from_rad(rotation_between_rad(*places[i].local_from_scan, right)), 0.1);
  }
}

TEST(PlacementSlow, AScanOfAnotherTunnelIsNotPlaced) {
  const SampleMine mine = sample_mine(MineKind::straight, 3, 3);
  std::vector<PreparedScan> scans = all_prepared(mine);
  scans.insert(scans.begin(), prepared_at(sample_mine(MineKind::straight, 31, 3), 1, 77));
  Progress progress;
  const auto places = place_scans(scans, std::vector<std::optional<Pose>>(scans.size()), {}, progress);
  EXPECT_FALSE(places[0].local_from_scan);
  EXPECT_NE(places[0].why_not.find("no other scan shows enough"), std::string::npos);
  for (std::size_t i = 1; i < scans.size(); ++i) EXPECT_TRUE(places[i].local_from_scan) << places[i].why_not;
}

TEST(PlacementSlow, AScanIsPlacedBesideThoseThatAreKnown) {
  const SampleMine mine = sample_mine(MineKind::curved, 5, 3);
  const std::vector<PreparedScan> scans = all_prepared(mine);
  Progress progress;
  // Guesses are guesses: one that is off does not keep the others out.
  const Pose guess = off(mine.stations[2], {0.4, 0.2, 0.0}, 1.0);
  const auto places = place_scans(scans, {std::nullopt, mine.stations[1], guess}, {}, progress);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(places[i].local_from_scan) << places[i].why_not;
    EXPECT_LT(distance_between_m(*places[i].local_from_scan, mine.stations[i]), 0.02);
  }
  EXPECT_EQ(places[2].local_from_scan->matrix(), guess.matrix());
}

TEST(PlacementSlow, SameBytesOnOneThreadAndTwo) {
  const std::vector<PreparedScan> scans = all_prepared(sample_mine(MineKind::niches, 7, 2));
  const auto pose = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Progress progress;
    return *place_scans(scans, std::vector<std::optional<Pose>>(2), {}, progress)[1].local_from_scan;
  };
  EXPECT_EQ(pose(1).matrix(), pose(2).matrix());
}

TEST(PlacementSlow, ASmoothLiningPlacesNothing) {
  SampleMine far_from_face;
  const Alignment axis = mine_axis({100, 200, 30}, 0.3, 200.0, 0.0, 0.0);
  far_from_face.tunnels.push_back(mine_tunnel(axis, 190.0, 1, smooth_lining()));
  far_from_face.stations = {mine_station(axis, 80.0, Random(4), 1, 0.0), mine_station(axis, 89.0, Random(4), 2, 0.0)};
  const std::vector<PreparedScan> scans = all_prepared(far_from_face);
  Progress progress;
  const auto places = place_scans(scans, std::vector<std::optional<Pose>>(2), {}, progress);
  EXPECT_TRUE(places[0].local_from_scan);  // the frame
  EXPECT_FALSE(places[1].local_from_scan);
  EXPECT_TRUE(places[1].why_not.find("smooth") != std::string::npos ||
              places[1].why_not.find("more than one place") != std::string::npos)
      << places[1].why_not;
}

TEST(PlanView, FindsTheFloorUnderATiltedScanner) {
  const SampleMine mine = sample_mine(MineKind::straight, 4, 2);  // tilted, on a grade
  const PreparedScan scan = prepared_at(mine, 0, 5);
  const PlanView view = plan_view(scan.pyramid.levels[scan.pyramid.level_near(0.4)]);
  ASSERT_TRUE(view.has_floor);
  const auto at = mine.tunnels[0].design().alignment().to_tunnel(mine.stations[0].translation());
  EXPECT_NEAR(view.scan_from_level.translation().norm(), at->z_m, 0.1);  // the floor lies a little below the line
  const Eigen::Vector3d up = mine.stations[0].linear() * view.scan_from_level.linear().col(2);
  EXPECT_GT(up.z(), std::cos(std::atan(0.1) + 0.02));
  EXPECT_GT(view.walls.size(), 200U);
}

TEST(PlanView, KeepsWithinItsMapOverADeepTiltedFloor) {
  // Looking down a shaft: a sloping floor 20 m below, and walls as far away as a scan reaches.
  std::vector<Eigen::Vector3f> points;
  for (float x = -9.0F; x < 9.0F; x += 0.05F)
    for (float y = -9.0F; y < 9.0F; y += 0.05F) points.emplace_back(x, y, -20.0F + 0.4F * x);
  for (float y = -4.0F; y < 4.0F; y += 0.05F)
    for (float z = -20.0F; z < 10.0F; z += 0.05F)
      for (const float x : {-24.0F, -16.0F, 16.0F, 24.0F}) points.emplace_back(x, y, z);
  const PlanView view = plan_view(DistributionMap(cell_sums(points, 0.4), 0.4, {}));
  ASSERT_TRUE(view.has_floor);
  for (const auto& wall : view.walls) EXPECT_LT(wall.norm(), 25.0);
  EXPECT_FALSE(plan_matches(view, view, 22.0, 10).empty());
}

TEST(RangeImage, KnowsWhatWasSeenThrough) {
  std::vector<Eigen::Vector3f> sphere;
  for (double a = -pi; a < pi; a += 0.02)
    for (double e = -0.5; e < 1.5; e += 0.02)
      sphere.emplace_back(
          Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)).cast<float>() * 5.0F);
  const RangeImage image(sphere);
  const Eigen::Vector3d direction = Eigen::Vector3d(-1.0, 0.01, 0.3).normalized();  // across the seam of azimuth
  EXPECT_EQ(image.sight_of(3.0 * direction, 0.5), Sight::seen_through);
  EXPECT_EQ(image.sight_of(5.2 * direction, 0.5), Sight::on_surface);
  EXPECT_EQ(image.sight_of(6.0 * direction, 0.5), Sight::hidden);
  EXPECT_EQ(image.sight_of({0.0, 0.0, -3.0}, 0.5), Sight::unknown);
  EXPECT_EQ(RangeImage().sight_of(direction, 0.5), Sight::unknown);
}

}  // namespace
}  // namespace adit
