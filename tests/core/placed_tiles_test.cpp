// Queries against what a plain look at every point gives.

#include "core/profiling/placed_tiles.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/foundation/random.h"
#include "core/profiling/tunnel_frames.h"

namespace adit {
namespace {

/// A straight, a clothoid, an arc to the right, a clothoid back to a left arc; a parabola in the grade line.
Alignment winding_axis() {
  std::vector<HorizontalElement> elements(1);
  elements[0].azimuth_rad = 0.6;
  elements[0].length_m = 40.0;
  const auto add = [&](HorizontalKind kind, double length_m, double from_k, double to_k) {
    const PlanPoint end = element_point(elements.back(), elements.back().length_m);
    HorizontalElement next;
    next.kind = kind;
    next.start = end.position;
    next.azimuth_rad = end.azimuth_rad;
    next.length_m = length_m;
    next.start_curvature_per_m = from_k;
    next.end_curvature_per_m = to_k;
    elements.push_back(next);
  };
  add(HorizontalKind::clothoid, 30.0, 0.0, 1.0 / 80.0);
  add(HorizontalKind::arc, 40.0, 1.0 / 80.0, 1.0 / 80.0);
  add(HorizontalKind::clothoid, 50.0, 1.0 / 80.0, -1.0 / 60.0);
  add(HorizontalKind::arc, 30.0, -1.0 / 60.0, -1.0 / 60.0);
  std::vector<VerticalPoint> grade(3);
  grade[0].elevation_m = 5.0;
  grade[1].chainage_m = 90.0;
  grade[1].elevation_m = 8.0;
  grade[1].curve = VerticalCurveKind::parabola;
  grade[1].curve_length_m = 40.0;
  grade[2].chainage_m = 190.0;
  grade[2].elevation_m = 4.0;
  return {"winding", HorizontalAlignment(elements, 0.0), VerticalAlignment(grade)};
}

TEST(TunnelFrames, AgreeWithTheExactFootEverywhere) {
  const Alignment axis = winding_axis();
  const TunnelFrames frames(axis, 0.0, 190.0);
  const Random random(3);
  double worst = 0.0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const TunnelPoint place{random.uniform(4 * i, 0.01, 189.99), random.uniform(4 * i + 1, -8, 8),
                            random.uniform(4 * i + 2, -2, 9)};
    const Eigen::Vector3d point = axis.to_site(place);
    const auto at = frames.to_tunnel(point, place.s_m + random.uniform(4 * i + 3, -15, 15));
    ASSERT_TRUE(at) << place.s_m;
    const auto exact = axis.to_tunnel(point, place.s_m);
    worst = std::max(
        {worst, std::abs(at->s_m - exact->s_m), std::abs(at->x_m - exact->x_m), std::abs(at->z_m - exact->z_m)});
  }
  EXPECT_LT(worst, 2e-5);
}

TEST(TunnelFrames, BeyondTheStretchThereIsNothing) {
  const Alignment axis = winding_axis();
  const TunnelFrames frames(axis, 60.0, 61.0);
  for (double s = 40.0; s < 90.0; s += 0.13)
    for (const double x : {-6.0, 0.0, 6.0})
      for (const double guess : {-10.0, 0.0, 10.0})
        EXPECT_EQ(frames.to_tunnel(axis.to_site({s, x, 1.0}), s + guess).has_value(), s >= 60.0 && s < 61.0) << s;
}

/// A straight, a curve of 12 m radius, and behind a kink another straight: as bad as an axis gets.
Alignment sharp_axis() {
  std::vector<HorizontalElement> elements(3);
  elements[0].azimuth_rad = 0.3;
  elements[0].length_m = 90.0;
  const auto begin_behind = [&](HorizontalElement& next, const HorizontalElement& before, double kink_rad) {
    const PlanPoint end = element_point(before, before.length_m);
    next.start = end.position;
    next.azimuth_rad = end.azimuth_rad + kink_rad;
  };
  elements[1].kind = HorizontalKind::arc;
  elements[1].length_m = 14.0;
  elements[1].start_curvature_per_m = elements[1].end_curvature_per_m = 1.0 / 12.0;
  begin_behind(elements[1], elements[0], 0.0);
  elements[2].length_m = 86.0;
  begin_behind(elements[2], elements[1], 0.08);
  std::vector<VerticalPoint> grade(2);
  grade[1].chainage_m = 190.0;
  return {"sharp", HorizontalAlignment(elements, 0.0), VerticalAlignment(grade)};
}

struct Survey {
  Alignment axis;
  std::vector<PlacedTiles> scans;
  std::vector<Eigen::Vector3d> points;  ///< local, in any order

  explicit Survey(Alignment along = winding_axis()) : axis(std::move(along)) {
    const Random random(8);
    std::uint64_t n = 0;
    for (const double s : {30.0, 70.0, 130.0}) {
      PlacedTiles scan;
      scan.local_from_scan = make_pose(axis.to_site({s, 0.5, 1.7}), {s, 0.01, -0.02});
      PointCloud cloud;
      for (int i = 0; i < 20000; ++i) {
        const double angle = random.uniform(n++, 0.0, 6.28);
        const Eigen::Vector3d place = axis.to_site({std::clamp(s + 12.0 * random.normal(n++), 0.5, 189.5),
                                                    4.5 * std::cos(angle), 3.0 + 4.5 * std::sin(angle)});
        cloud.points.push_back((scan.local_from_scan.inverse() * place).cast<float>());
        points.push_back(scan.local_from_scan * cloud.points.back().cast<double>());
      }
      scan.points = std::make_shared<CloudTiles>(std::move(cloud), 1000);
      scans.push_back(scan);
    }
  }
};

TEST(Queries, ASlabHoldsEveryPointOfItsChainages) {
  const Survey survey;
  const ChainageIndex index(survey.scans, survey.axis);
  Progress progress;
  for (const double from : {12.0, 69.9, 100.0, 118.3, 160.0}) {
    const double to = from + 0.8;
    std::vector<double> expected, found;
    for (const auto& p : survey.points)
      if (const auto at = survey.axis.to_tunnel(p); at && at->s_m >= from && at->s_m < to) expected.push_back(at->s_m);
    for (const SlabPoint& p : points_of_slab(survey.scans, index, survey.axis, from, to, progress)) {
      found.push_back(p.at.s_m);
      EXPECT_GT(p.range_m, 0.0F);
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), expected.size()) << from;
    EXPECT_GT(found.size(), 20U);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 2e-5);
  }
}

/// Tiles of several metres reach over joints, round a tight curve and over a kink.
TEST(Queries, ASlabHoldsEveryPointWhereTheAxisTurnsSharply) {
  const Survey survey(sharp_axis());
  const ChainageIndex index(survey.scans, survey.axis);
  Progress progress;
  std::vector<double> chainages;
  for (const auto& p : survey.points)
    if (const auto at = survey.axis.to_tunnel(p)) chainages.push_back(at->s_m);
  const auto expected = [&](double from, double to) {
    return std::count_if(chainages.begin(), chainages.end(), [&](double s) { return s >= from && s < to; });
  };
  const auto found = [&](double from, double to) {
    return static_cast<std::ptrdiff_t>(points_of_slab(survey.scans, index, survey.axis, from, to, progress).size());
  };
  std::ptrdiff_t all = 0, at_the_kink = 0;
  for (double from = 60.2; from < 130.0; from += 0.5) {  // the joints at 90 and 104 lie within slabs
    const std::ptrdiff_t here = found(from, from + 0.5);
    // On the inner side of the kink a point has a foot on either side of it, and may count there or here, but once.
    if (from > 102.5 && from < 105.0)
      at_the_kink += here - expected(from, from + 0.5);
    else
      EXPECT_EQ(here, expected(from, from + 0.5)) << from;
    all += here;
  }
  EXPECT_EQ(at_the_kink, 0);
  EXPECT_GT(all, 20000);
}

TEST(Queries, ABoxHoldsEveryPointInIt) {
  const Survey survey;
  Progress progress;
  const Eigen::Vector3d middle = survey.axis.to_site({75.0, 3.0, 4.0});
  const BoundingBox box(middle - Eigen::Vector3d(3, 4, 2), middle + Eigen::Vector3d(3, 4, 2));
  const auto count =
      std::count_if(survey.points.begin(), survey.points.end(), [&](const auto& p) { return box.contains(p); });
  const auto found = points_in_box(survey.scans, box, progress);
  EXPECT_GT(count, 100);
  EXPECT_EQ(found.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(found, points_in_box(survey.scans, box, progress));
}

TEST(Queries, FewTilesReachASlab) {
  const Survey survey;
  const ChainageIndex index(survey.scans, survey.axis);
  EXPECT_EQ(index.all().size(), 60U);
  EXPECT_LT(index.between(70.0, 70.2).size(), 30U);
  EXPECT_TRUE(index.between(1000.0, 1001.0).empty());
}

}  // namespace
}  // namespace adit
