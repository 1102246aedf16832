#include "core/georeference/scan_targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/georeference/scan_view.h"
#include "core/simulation/rock_mesh.h"
#include "core/simulation/scanner.h"
#include "tests/core/sample_tunnel.h"

namespace adit {
namespace {

using namespace tests;

/// Targets about a scanner that looks along the tunnel, and what a scan of a sector shows of them.
struct Seen {
  Pose design_from_scan = Pose::Identity();
  std::vector<ScannedTarget> hung;
  std::vector<ScanTarget> found;
};

Seen scanned(double step_mrad, std::uint64_t seed) {
  const RockTunnel rock = sample_rock();
  const Random random(seed, 4);
  Seen seen;
  const double s = 30.0;
  const PlanPoint plan = rock.design().alignment().horizontal().at(s);
  seen.design_from_scan = make_pose(rock.design().alignment().to_site({s, 0.3, 1.6}),
                                    {std::atan2(plan.tangent().y(), plan.tangent().x()), 0.004, -0.006});
  const double length = rock.profile().length_m();
  for (int i = 0; i < 8; ++i) {
    const auto n = static_cast<std::uint64_t>(i);
    ScannedTarget target;
    target.kind = i % 2 == 0 ? TargetKind::quarters : TargetKind::coded;
    target.radius_m = i % 2 == 0 ? 0.10 : 0.075;
    target.code = code_of_id(i + 1);
    target.pose = place_facing_back(rock, s + 5.0 + 0.8 * i, length * random.uniform(n, -0.25, 0.25), 0.15);
    seen.hung.push_back(target);
  }
  for (int i = 0; i < 4; ++i) {
    ScannedTarget target;
    target.radius_m = 0.0725;
    target.pose.translation() = rock.design().alignment().to_site({s + 4.5 + 1.9 * i, -1.5 + 0.9 * i, 0.5 + 0.2 * i});
    seen.hung.push_back(target);
  }
  ScannerOptions options;
  options.seed = seed;
  options.from_azimuth_deg = -45.0;
  options.to_azimuth_deg = 45.0;
  options.lowest_elevation_deg = -25.0;
  options.highest_elevation_deg = 45.0;
  options.pulses = static_cast<std::uint64_t>(rad_from_deg(90.0) * rad_from_deg(70.0) / std::pow(1e-3 * step_mrad, 2));
  options.targets = seen.hung;
  Progress progress;
  const CloudTiles tiles(scan_tunnel(rock, seen.design_from_scan, options, {}, progress));
  ScanTargetOptions find;
  find.sphere_radius_m = 0.0725;
  find.quarters = find.coded = true;
  seen.found = find_scan_targets(tiles, find, progress);
  return seen;
}

TEST(ScanView, EveryDirectionLiesWellInsideOne) {
  // A board of 20 cm, 1.5 m away, lies whole in it; and not in a corner, where points lie apart.
  constexpr double reach = 0.09, half_width = 0.6, least_ahead = 0.8;
  const Random random(5, 5);
  const auto views = views_about();
  for (std::uint64_t k = 0; k < 3000; k += 3) {
    const Eigen::Vector3d direction =
        Eigen::Vector3d(random.normal(k), random.normal(k + 1), random.normal(k + 2)).normalized();
    EXPECT_TRUE(std::any_of(views.begin(), views.end(), [&](const Eigen::Matrix3d& scan_from_view) {
      const Eigen::Vector3d seen = scan_from_view.transpose() * direction;
      return seen.z() > least_ahead && std::abs(seen.x() / seen.z()) < half_width - reach &&
             std::abs(seen.y() / seen.z()) < half_width - reach;
    })) << direction.transpose();
  }
  for (const Eigen::Matrix3d& view : views) EXPECT_NEAR(view.determinant(), 1.0, 1e-12);
}

TEST(ScanView, WhitePaperBeforeRockIsNotCutOff) {
  // A wall 5 m ahead of intensity 0.15, on it a board of 0.9: what is cut off moves the edges of targets.
  constexpr float rock = 0.15F, paper = 0.9F;
  PointCloud wall;
  for (int i = -200; i <= 200; ++i)
    for (int j = -200; j <= 200; ++j) {
      wall.points.emplace_back(5.0F, 0.01F * static_cast<float>(i), 0.01F * static_cast<float>(j));
      wall.intensity.push_back(std::abs(i) < 15 && std::abs(j) < 15 ? paper : rock);
    }
  Progress progress;
  const CloudTiles tiles(wall);
  const ScanView view = scan_view(tiles, views_about().front(), 400.0, progress);
  const auto grey_at = [&](double y) {
    const Eigen::Vector2d pixel = *view.pixel_of({5.0, y, 0.0});
    return static_cast<double>(view.grey.at(static_cast<int>(pixel.x() + 0.5), static_cast<int>(pixel.y() + 0.5)));
  };
  EXPECT_LT(grey_at(0.0), 255.0);
  EXPECT_NEAR(grey_at(0.0) / grey_at(1.0), static_cast<double>(paper / rock), 0.1);
}

TEST(ScanTargetsSlow, SpheresQuartersAndCodedOnesWithinAMillimetre) {
  // Points 6 mm apart at 10 m.
  const Seen seen = scanned(0.6, 1);
  std::size_t found_count = 0, near_count = 0, within = 0;
  for (const ScannedTarget& hung : seen.hung) {
    const Eigen::Vector3d at = seen.design_from_scan.inverse() * hung.pose.translation();
    const auto found = std::find_if(seen.found.begin(), seen.found.end(), [&](const ScanTarget& target) {
      return target.kind == hung.kind && (target.center - at).norm() < 0.05;
    });
    if (found == seen.found.end()) continue;
    ++found_count;
    const double off_m = (found->center - at).norm();
    EXPECT_LT(off_m, 4.0 * found->sigma_m) << at.norm();
    if (at.norm() <= 10.3) {
      ++near_count;
      within += off_m < 0.001 ? 1 : 0;
      EXPECT_LT(off_m, 0.001) << static_cast<int>(hung.kind) << " at " << at.transpose();
    }
    if (hung.kind == TargetKind::coded) {
      EXPECT_EQ(found->code_id, id_of_code(hung.code));
    }
    if (hung.kind == TargetKind::sphere) {
      EXPECT_NEAR(found->size_m, 0.145, 0.003);
    }
  }
  EXPECT_GE(found_count, 11U);  // of 12; those beyond 10 m are small or stand behind rock in part
  EXPECT_EQ(within, near_count);
  EXPECT_GE(near_count, 9U);
  for (const ScanTarget& found : seen.found)
    EXPECT_TRUE(std::any_of(seen.hung.begin(), seen.hung.end(),
                            [&](const ScannedTarget& hung) {
                              return (seen.design_from_scan * found.center - hung.pose.translation()).norm() < 0.05;
                            }))
        << "nothing hangs at " << found.center.transpose();
}

}  // namespace
}  // namespace adit
