#include "core/profiling/sectors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "core/profiling/profiling.h"
#include "tests/core/sample_map.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

TEST(Sectors, AShellOfACircleFallsToItsSectorsByTheirAngles) {
  const double d = 0.2, radius = 4.0;
  const DesignTunnel design = tests::sample_design(tests::circle_profile(radius));
  const DeviationMap map = tests::map_of(design, [&](double, const ProfilePoint&) { return d; });
  const auto sectors = sector_volumes(map, design, {"line", 0.0}, standard_sectors(), 20, 28, 1.0);
  ASSERT_EQ(sectors.size(), 6U);
  const double whole = pi * ((radius + d) * (radius + d) - radius * radius) * 8.0;
  double sum = 0.0;
  for (const SectorVolume& sector : sectors) sum += sector.overbreak_m3;
  EXPECT_NEAR(sum, whole, 1e-3 * whole);
  EXPECT_EQ(sectors[0].name, "crown");
  EXPECT_NEAR(sectors[0].overbreak_m3, whole * 60 / 360, 0.01 * whole);
  EXPECT_NEAR(sectors[3].overbreak_m3, whole * 90 / 360, 0.01 * whole);
  EXPECT_NEAR(sectors[0].max_overbreak_m, d, 1e-6);
  EXPECT_EQ(sectors[0].underbreak_m3, 0.0);
}

TEST(Sectors, TheySumToTheSlicesOnACurveWithOverAndUnderMixed) {
  const DesignTunnel design = tests::sample_design(tests::arch_profile(), 60.0);
  const DeviationMap map = tests::map_of(design, [](double s, const ProfilePoint& at) {
    return 0.1 * std::sin(3.0 * at.p_m) + 0.08 * std::sin(2.0 * s) + 0.03;
  });
  Progress progress;
  for (const double offset : {0.0, 0.15}) {
    const DesignLine line{"line", offset};
    const Volume volume = compute_volume(map, design, line, 20.03, 27.9, 1.0, {}, {}, progress);
    double over = 0.0, under = 0.0;
    for (const SectorVolume& sector : sector_volumes(map, design, line, standard_sectors(), 20.03, 27.9, 1.5)) {
      over += sector.overbreak_m3;
      under += sector.underbreak_m3;
    }
    EXPECT_NEAR(over, volume.slices.overbreak_m3, 0.005 * volume.slices.overbreak_m3) << offset;
    EXPECT_NEAR(under, volume.slices.underbreak_m3, 0.005 * volume.slices.underbreak_m3) << offset;
  }
}

TEST(Sectors, ThoseThatDoNotCoverTheProfileOnceAreRefused) {
  EXPECT_NO_THROW(check_sectors(standard_sectors()));
  EXPECT_NO_THROW(check_sectors({{"upper", -90, 90}, {"lower", 90, -90}}));
  EXPECT_THROW(check_sectors({{"upper", -90, 90}}), Error);
  EXPECT_THROW(check_sectors({{"upper", -90, 90}, {"lower", 80, -90}}), Error);
  EXPECT_THROW(check_sectors({{"a", -90, 90}, {"a", 90, -90}}), Error);
  EXPECT_THROW(check_sectors({}), Error);
}

TEST(RoundReview, ALookOutIsFoundAndARoughContourDoesNotPromiseTooMuch) {
  const DesignTunnel design = tests::sample_design(tests::arch_profile());
  const auto tooth = [](double s, const ProfilePoint& at) {
    return at.normal.y() < -0.5 ? -0.05 : 0.06 + 0.08 * (s - 20.0);
  };
  const RoundReview smooth = review_round(tests::map_of(design, tooth), design, {"line", 0.0}, 20, 28, 1.0);
  EXPECT_NEAR(smooth.lookout_per_m, 0.08, 1e-4);
  EXPECT_NEAR(smooth.lookout_collar_m, 0.06, 1e-3);
  EXPECT_NEAR(smooth.lookout_toe_m, 0.70, 1e-3);
  EXPECT_NEAR(smooth.lookout_sigma_per_m, 0.0, 1e-4);
  EXPECT_NEAR(smooth.affected_share, 1.0, 1e-12);
  EXPECT_NEAR(smooth.mean_overbreak_m, 0.38, 1e-3);
  const DeviationMap rough = tests::map_of(
      design, [&](double s, const ProfilePoint& at) { return tooth(s, at) + 0.05 * std::sin(0.6 * s + 2.0 * at.p_m); });
  const RoundReview review = review_round(rough, design, {"line", 0.0}, 20, 28, 1.0);
  EXPECT_NEAR(review.lookout_per_m, 0.08, 2.0 * review.lookout_sigma_per_m);
  EXPECT_GT(review.lookout_sigma_per_m, 0.0005);
  EXPECT_GT(review.contour_ratio, smooth.contour_ratio);
  DeviationMap unseen = rough;
  for (MapCell& cell : unseen.cells) cell = MapCell{};
  EXPECT_TRUE(std::isnan(review_round(unseen, design, {"line", 0.0}, 20, 28, 1.0).lookout_per_m));
}

TEST(VolumeOfProfiles, AChangeInsideASliceCountsEachProfileForItsPart) {
  const Alignment axis = tests::sample_axis();
  const DesignTunnel design(axis, {{0.0, tests::circle_profile(4.0)}, {23.47, tests::circle_profile(5.0)}},
                            {{"line", 0.0}});
  const DeviationMap map = tests::map_of(design, [](double, const ProfilePoint&) { return 0.0; });
  Progress progress;
  for (const double slice_m : {0.1, 1.0}) {
    DeviationMap sliced = map;
    sliced.step_s_m = slice_m;
    sliced.rows = static_cast<std::size_t>(std::lround(8.0 / slice_m));
    sliced.cells.resize(sliced.rows * sliced.columns);
    const Volume volume = compute_volume(sliced, design, {"line", 0.0}, 20, 28, 1.0, {}, {}, progress);
    EXPECT_NEAR(volume.slices.design_m3, pi * (16.0 * 3.47 + 25.0 * 4.53), 0.01) << slice_m;
    EXPECT_NEAR(volume.closure_m3, 0.0, 1e-3);
  }
}

}  // namespace
}  // namespace adit
