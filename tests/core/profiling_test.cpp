#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "core/profiling/object_cells.h"
#include "core/profiling/outline.h"
#include "core/profiling/overbreak.h"
#include "core/profiling/profiling.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

using namespace tests;

/// Points on a surface at deviation(s, angle) from a circular tunnel of 4 m radius, in the frame of the design.
PointCloud circle_points(const Alignment& axis, double from_m, double to_m, const Eigen::Vector3d& origin,
                         const std::function<double(double, double)>& deviation) {
  PointCloud cloud;
  const Random random(3);
  std::uint64_t i = 0;
  for (double s = from_m; s < to_m; s += 0.025)
    for (double a = 0.0; a < 2.0 * pi; a += 0.008, ++i) {
      const double chainage = s + 0.025 * random.uniform(2 * i);
      const double angle = a + 0.008 * random.uniform(2 * i + 1);
      const double r = 4.0 + deviation(chainage, angle);
      const Eigen::Vector3d at = axis.to_site({chainage, r * std::sin(angle), r * std::cos(angle)});
      cloud.points.push_back((at - origin).cast<float>());
    }
  return cloud;
}

PlacedTiles placed(PointCloud cloud, const Eigen::Vector3d& scanner) {
  for (auto& p : cloud.points) p -= scanner.cast<float>();
  PlacedTiles tiles;
  tiles.name = "S";
  tiles.points = std::make_shared<CloudTiles>(std::move(cloud));
  tiles.local_from_scan.translation() = scanner;
  return tiles;
}

Volume volume_of(const DesignTunnel& design, const PlacedTiles& scan, double from_m, double to_m,
                 const DesignLine& line) {
  Progress progress;
  const ProfilingOptions options;
  const MapResult result = map_deviations({scan}, design, from_m, to_m, options, progress);
  return compute_volume(result.map, design, line, from_m, to_m, 1.0, {}, options, progress);
}

TEST(Volume, OfATorusIsExact) {
  // dV/ds of a circle of radius R on a plan curve centred on the axis: pi R^2, whatever the curvature.
  const DesignTunnel design = sample_design(circle_profile(), 60.0);
  const PointCloud cloud =
      circle_points(design.alignment(), 39.0, 51.0, Eigen::Vector3d::Zero(), [](double, double) { return 0.25; });
  const Volume volume =
      volume_of(design, placed(cloud, design.alignment().to_site({45, 0, 0})), 40.0, 50.0, {"excavation", 0.0});
  EXPECT_NEAR(volume.slices.design_m3, 10.0 * pi * 16.0, 0.01);
  EXPECT_NEAR(volume.slices.excavated_m3, 10.0 * pi * 4.25 * 4.25, 0.02);
  EXPECT_NEAR(volume.slices.overbreak_m3, 10.0 * pi * (4.25 * 4.25 - 16.0), 0.02);
  EXPECT_NEAR(volume.slices.underbreak_m3, 0.0, 1e-3);
  EXPECT_NEAR(volume.closure_m3, 0.0, 1e-4);
  EXPECT_GT(volume.coverage, 0.999);
  EXPECT_NEAR(volume.average_end_area.overbreak_m3, 10.0 * pi * (4.25 * 4.25 - 16.0), 0.03);
}

TEST(Volume, WithOverbreakOnTheOuterWallFollowsPlanCurvature) {
  // 0.3 m on the left half only; on a curve to the right of radius 60 m the left lies outside: dV = ds (A - k M).
  const DesignTunnel design = sample_design(circle_profile(), 60.0);
  const auto left = [](double, double angle) { return std::sin(angle) < 0.0 ? 0.3 : 0.0; };
  const PointCloud cloud = circle_points(design.alignment(), 39.0, 51.0, Eigen::Vector3d::Zero(), left);
  const Volume volume =
      volume_of(design, placed(cloud, design.alignment().to_site({45, 0, 0})), 40.0, 50.0, {"excavation", 0.0});
  const double area = pi / 2.0 * (4.3 * 4.3 - 16.0);
  const double moment = -2.0 / 3.0 * (4.3 * 4.3 * 4.3 - 64.0);
  EXPECT_NEAR(volume.slices.overbreak_m3, 10.0 * (area - moment / 60.0), 0.25);  // the two steps cost half a cell each
  EXPECT_GT(moment / 60.0 / area, -0.06);
  EXPECT_GT(std::abs(10.0 * moment / 60.0), 0.5);  // without the curvature the test would fail
}

TEST(Volume, IdentitiesHoldForEveryLineAndRoundsSumToTheTotal) {
  const DesignTunnel design = sample_design(circle_profile(), 100.0);
  const auto bumps = [](double s, double angle) { return 0.15 + 0.2 * std::sin(3.0 * angle) * std::cos(0.9 * s); };
  const PlacedTiles scan = placed(circle_points(design.alignment(), 39.0, 51.0, Eigen::Vector3d::Zero(), bumps),
                                  design.alignment().to_site({45, 0, 0}));
  for (const DesignLine& line : design.lines()) {
    const Volume whole = volume_of(design, scan, 40.0, 50.0, line);
    EXPECT_NEAR(whole.closure_m3, 0.0, 1e-3);
    Progress progress;
    const ProfilingOptions options;
    const MapResult map = map_deviations({scan}, design, 40.0, 50.0, options, progress);
    double over = 0.0, under = 0.0;
    for (const auto& [from, to] : {std::pair{40.0, 43.33}, std::pair{43.33, 47.0}, std::pair{47.0, 50.0}}) {
      const Volume round = compute_volume(map.map, design, line, from, to, 1.0, {}, options, progress);
      over += round.slices.overbreak_m3;
      under += round.slices.underbreak_m3;
    }
    EXPECT_NEAR(over, whole.slices.overbreak_m3, 1e-9);
    EXPECT_NEAR(under, whole.slices.underbreak_m3, 1e-9);
  }
}

TEST(Section, SameNearZeroAndWithLargeCoordinates) {
  // Poses in site minus a whole-metre origin, as the app keeps them; scans in their own frame.
  const auto bumps = [](double s, double angle) { return 0.1 + 0.1 * std::sin(2.0 * angle) * std::cos(0.7 * s); };
  std::vector<Section> sections;
  for (const Eigen::Vector3d& start : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2683026.0, 1251466.0, 400.0),
                                       Eigen::Vector3d(612345.0, 6998765.0, 412.0)}) {
    const DesignTunnel site = sample_design(circle_profile(), 150.0, start);
    const Eigen::Vector3d origin = start.array().round();
    const DesignTunnel design = site.relative_to(origin);
    const Alignment near_zero = sample_axis(150.0);
    PlacedTiles scan =
        placed(circle_points(near_zero, 40.0, 46.0, Eigen::Vector3d::Zero(), bumps), near_zero.to_site({43, 0, 0}));
    Progress progress;
    const ProfilingOptions options;
    const MapResult map = map_deviations({scan}, design, 41.0, 45.0, options, progress);
    sections.push_back(cut_section(map.map, design, 43.0, options));
  }
  ASSERT_EQ(sections.size(), 3U);
  for (std::size_t k = 1; k < 3; ++k) {
    ASSERT_EQ(sections[k].outline.size(), sections[0].outline.size());
    for (std::size_t i = 0; i < sections[0].outline.size(); ++i)
      EXPECT_LT((sections[k].outline[i].position - sections[0].outline[i].position).norm(), 1e-4);
    EXPECT_NEAR(sections[k].lines[0].overbreak_m2, sections[0].lines[0].overbreak_m2, 1e-3);
  }
}

TEST(Section, AGapIsInterpolatedUpToItsLimitAndLeftOpenBeyond) {
  const DesignTunnel design = sample_design(circle_profile());
  const ProfileStretch stretch(design.profile_at(0.0));
  std::vector<MapCell> row(stretch.columns(0.1));
  for (auto& cell : row) cell = {0.2F, 0.0F, 10, 1.0F, CellKind::measured};
  for (std::size_t c = 50; c < 58; ++c) row[c] = MapCell{};    // 0.8 m
  for (std::size_t c = 120; c < 140; ++c) row[c] = MapCell{};  // 2 m
  const Outline outline = outline_of(row, stretch, 0.1, 1.0);
  EXPECT_NEAR(outline.interpolated_m, 0.8, 1e-9);
  EXPECT_NEAR(outline.unseen_m, 2.0, 1e-9);
  const SectionAreas areas =
      section_areas(outline, stretch, 0.1, line_polygon(design.profile_at(0.0), {"excavation", 0.0}));
  const double full = pi * (4.2 * 4.2 - 16.0);
  EXPECT_NEAR(areas.overbreak_m2, full * (1.0 - 2.0 / (8.0 * pi)), 0.03);  // unseen: as the design
  EXPECT_NEAR(areas.coverage, 1.0 - 2.8 / (8.0 * pi), 1e-6);
  const SectionAreas pay = section_areas(outline, stretch, 0.1, line_polygon(design.profile_at(0.0), {"pay", 0.2}));
  EXPECT_NEAR(pay.overbreak_m2 + pay.underbreak_m2, 0.0, 0.02);  // unseen: as the line asked for
}

TEST(Section, WhatLiesOutsideACornerIsKept) {
  const Profile square("square",
                       {{{-2, 0}, {-2, 4}, 0}, {{-2, 4}, {2, 4}, 0}, {{2, 4}, {2, 0}, 0}, {{2, 0}, {-2, 0}, 0}});
  const ProfileStretch stretch(square);
  std::vector<MapCell> row(stretch.columns(0.1));
  for (auto& cell : row) cell = {0.5F, 0.0F, 10, 1.0F, CellKind::measured};
  const Outline outline = outline_of(row, stretch, 0.1, 1.0);
  const SectionAreas areas = section_areas(outline, stretch, 0.1, line_polygon(square, {"excavation", 0.0}));
  EXPECT_NEAR(areas.overbreak_m2, 16.0 * 0.5 + pi * 0.25, 0.03);
  EXPECT_NEAR(outline.measured_m, 16.0, 1e-6);  // the wedges at the corners add nothing to the length of the line
}

TEST(Section, AGapAtACornerInventsNoUnderbreak) {
  const Profile square("square",
                       {{{-2, 0}, {-2, 4}, 0}, {{-2, 4}, {2, 4}, 0}, {{2, 4}, {2, 0}, 0}, {{2, 0}, {-2, 0}, 0}});
  const ProfileStretch stretch(square);
  for (const float deviation_m : {0.0F, 0.1F}) {
    std::vector<MapCell> row(stretch.columns(0.1));
    for (auto& cell : row) cell = {deviation_m, 0.0F, 10, 1.0F, CellKind::measured};
    for (std::size_t c = 0; c < row.size(); ++c) {
      const Eigen::Vector2d at = stretch.at((static_cast<double>(c) + 0.5) * 0.1).position;
      if ((at - Eigen::Vector2d(2.0, 4.0)).norm() < 0.45) row[c] = MapCell{};
    }
    const Outline outline = outline_of(row, stretch, 0.1, 1.0);
    EXPECT_GT(outline.interpolated_m, 0.7);
    EXPECT_NEAR(outline.unseen_m, 0.0, 1e-9);
    const SectionAreas areas = section_areas(outline, stretch, 0.1, line_polygon(square, {"excavation", 0.0}));
    EXPECT_NEAR(areas.underbreak_m2, 0.0, 1e-3);
    EXPECT_NEAR(areas.overbreak_m2, 16.0 * static_cast<double>(deviation_m), 0.05);
  }
}

TEST(Section, NoFanIsSpunAroundACornerFarOutside) {
  const Profile square("square",
                       {{{-2, 0}, {-2, 4}, 0}, {{-2, 4}, {2, 4}, 0}, {{2, 4}, {2, 0}, 0}, {{2, 0}, {-2, 0}, 0}});
  const ProfileStretch stretch(square);
  std::vector<MapCell> row(stretch.columns(0.1));
  for (std::size_t c = 0; c < row.size(); ++c) {
    const ProfilePoint at = stretch.at((static_cast<double>(c) + 0.5) * 0.1);
    const bool crown_or_right = at.normal.y() > 0.99 || at.normal.x() > 0.99;
    row[c] = {crown_or_right ? 2.0F : 0.0F, 0.0F, 10, 1.0F, CellKind::measured};
    if ((at.position - Eigen::Vector2d(2.0, 4.0)).norm() < 0.15) row[c] = MapCell{};
  }
  const Outline outline = outline_of(row, stretch, 0.1, 1.0);
  const SectionAreas areas = section_areas(outline, stretch, 0.1, line_polygon(square, {"excavation", 0.0}));
  EXPECT_LT(areas.overbreak_m2, 2.0 * 4.0 * 2.0 + 0.2);  // a fan would add pi square metres that nobody has seen
  EXPECT_GT(areas.overbreak_m2, 2.0 * 4.0 * 2.0 - 1.5);
  EXPECT_GT(outline.unseen_m, 0.1);
}

TEST(Map, ADuctInFrontOfTheRockIsLeftOutAndSaid) {
  const DesignTunnel design = sample_design(circle_profile());
  const auto duct = [](double, double angle) { return angle > 0.5 && angle < 0.65 ? -0.45 : 0.1; };
  const PlacedTiles scan = placed(circle_points(design.alignment(), 40.0, 44.0, Eigen::Vector3d::Zero(), duct),
                                  design.alignment().to_site({42, 0, 0}));
  Progress progress;
  const MapResult result = map_deviations({scan}, design, 40.5, 43.5, {}, progress);
  ASSERT_EQ(result.findings.size(), 1U);
  for (const MapCell& cell : result.map.cells)
    if (cell.kind == CellKind::measured) {
      EXPECT_GT(cell.deviation_m, -0.2F);
    }
}

TEST(Map, NoPointNearTheDesignIsRefusedWithAMend) {
  const DesignTunnel design = sample_design(circle_profile());
  PointCloud far;
  far.points.assign(100, Eigen::Vector3f(5.0F, 5.0F, 5.0F));
  PlacedTiles scan = placed(far, Eigen::Vector3d(1000, 1000, 0));
  Progress progress;
  EXPECT_THROW(map_deviations({scan}, design, 10.0, 20.0, {}, progress), Error);
}

std::vector<PlacedTiles> two_scans(const RockTunnel& rock) {
  std::vector<PlacedTiles> scans;
  for (int i = 0; i < 2; ++i) {
    const Pose pose = station(rock.design(), 36.0 + 8.0 * i, 20.0 * i);
    scans.push_back({"S" + std::to_string(i),
                     std::make_shared<CloudTiles>(scan_at(rock, pose, 3 + static_cast<std::uint64_t>(i), 60000)),
                     pose});
  }
  return scans;
}

void expect_same(const DeviationMap& a, const DeviationMap& b) {
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    EXPECT_EQ(a.cells[i].count, b.cells[i].count);
    if (a.cells[i].kind == CellKind::measured) {
      EXPECT_EQ(a.cells[i].deviation_m, b.cells[i].deviation_m);
    }
  }
}

TEST(Map, DoesNotDependOnTheOrderOfPointsOrScans) {
  const RockTunnel rock = sample_rock();
  std::vector<PlacedTiles> scans = two_scans(rock);
  Progress progress;
  const MapResult a = map_deviations(scans, rock.design(), 32.0, 48.0, {}, progress);
  std::swap(scans[0], scans[1]);
  expect_same(a.map, map_deviations(scans, rock.design(), 32.0, 48.0, {}, progress).map);
}

TEST(Map, DoesNotDependOnTheMemory) {
  const RockTunnel rock = sample_rock();
  const std::vector<PlacedTiles> scans = two_scans(rock);
  Progress progress;
  const MapResult a = map_deviations(scans, rock.design(), 32.0, 48.0, {}, progress);
  const MapResult b = map_deviations(scans, rock.design(), 32.0, 48.0, {}, progress, 10'000);  // row by row
  expect_same(a.map, b.map);
  EXPECT_EQ(a.points_used, b.points_used);
  EXPECT_EQ(a.points_inside, b.points_inside);
}

TEST(Section, StraightFromThePointsIsThatOfTheMap) {
  const RockTunnel rock = sample_rock();
  const std::vector<PlacedTiles> scans = two_scans(rock);
  const ChainageIndex index(scans, rock.design().alignment());
  Progress progress;
  const MapResult mapped = map_deviations(scans, rock.design(), 32.0, 48.0, {}, progress);
  for (const double chainage : {36.2, 39.0, 42.7}) {
    const Section a = cut_section(mapped.map, rock.design(), chainage, {});
    const Section b = cut_section(scans, index, rock.design(), chainage, {}, progress);
    EXPECT_NEAR(a.lines[0].area_m2, b.lines[0].area_m2, 0.003 * a.lines[0].area_m2) << chainage;
    EXPECT_NEAR(a.lines[0].overbreak_m2, b.lines[0].overbreak_m2, 0.1) << chainage;
    EXPECT_NEAR(a.lines[0].coverage, b.lines[0].coverage, 0.08) << chainage;
  }
}

TEST(Map, OfDenseTilesAnEvenSubsampleWillDo) {
  const RockTunnel rock = sample_rock();
  std::vector<PlacedTiles> scans{
      {"S", std::make_shared<CloudTiles>(scan_at(rock, station(rock.design(), 40.0, 0.0), 9, 400000)),
       station(rock.design(), 40.0, 0.0)}};
  Progress progress;
  ProfilingOptions coarse;
  coarse.slice_m = coarse.cell_m = 0.5;
  ProfilingOptions few = coarse;
  few.most_points_a_cell = 20;
  const MapResult all = map_deviations(scans, rock.design(), 38.0, 42.0, coarse, progress);
  const MapResult some = map_deviations(scans, rock.design(), 38.0, 42.0, few, progress);
  EXPECT_LT(some.points_used, all.points_used);
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < all.map.cells.size(); ++i) {
    if (all.map.cells[i].kind != CellKind::measured || some.map.cells[i].kind != CellKind::measured) continue;
    sum += std::abs(static_cast<double>(all.map.cells[i].deviation_m - some.map.cells[i].deviation_m));
    count += 1.0;
  }
  EXPECT_GT(count, 200.0);
  EXPECT_LT(sum / count, 0.005);
}

TEST(VolumeSlow, OfASimulatedTunnelIsWithinOnePercentAndItsSigma) {
  const RockTunnel rock = sample_rock();
  std::vector<PlacedTiles> scans;
  for (int i = 0; i < 3; ++i) {
    const Pose pose = station(rock.design(), 30.0 + 11.0 * i, 70.0 * i);
    scans.push_back({"S" + std::to_string(i),
                     std::make_shared<CloudTiles>(scan_at(rock, pose, 30 + static_cast<std::uint64_t>(i), 900000)),
                     pose});
  }
  Progress progress;
  const MapResult map = map_deviations(scans, rock.design(), 28.0, 54.0, {}, progress);
  const Volume volume = compute_volume(map.map, rock.design(), {"excavation", 0.0}, 28.0, 54.0, 1.0, {}, {}, progress);
  const VolumeAmounts truth = true_volume(rock, 28.0, 54.0, progress);
  EXPECT_NEAR(volume.slices.excavated_m3 / truth.excavated_m3, 1.0, 0.002);
  EXPECT_NEAR(volume.slices.overbreak_m3 / truth.overbreak_m3, 1.0, 0.01);
  EXPECT_LT(std::abs(volume.slices.overbreak_m3 - truth.overbreak_m3), 3.0 * volume.sigma_overbreak_m3);
  EXPECT_LT(std::abs(volume.slices.excavated_m3 - truth.excavated_m3), 3.0 * volume.sigma_excavated_m3);
}

}  // namespace
}  // namespace adit
