// Spheres, boards of quarters and coded targets about 10 m away in simulated scans: how many are found, how far off.

#include <cmath>
#include <cstdio>
#include <map>

#include "core/foundation/angle.h"
#include "core/foundation/random.h"
#include "core/geometry/tile_source.h"
#include "core/georeference/scan_targets.h"
#include "core/simulation/scanner.h"
#include "tests/bench/bench.h"
#include "tests/bench/target_pictures.h"

namespace adit::bench {
namespace {

struct Row {
  int hung = 0, found = 0, within = 0, wrong = 0;
  double squares = 0.0, normalised = 0.0, worst_m = 0.0;
};

constexpr double sphere_radius_m = 0.0725, board_radius_m = 0.10, coded_radius_m = 0.075;

/// Five by five of them in the sector that is scanned, 8.5 to 10.3 m away, up to 40 degrees oblique.
std::vector<ScannedTarget> hung_before(const Pose& site_from_scan, const Random& random) {
  std::vector<ScannedTarget> hung;
  std::uint64_t k = 0;
  for (int row = -2; row <= 2; ++row)
    for (int column = -2; column <= 2; ++column) {
      const double range_m = random.uniform(k++, 8.5, 10.3), azimuth = rad_from_deg(4.4 * column),
                   elevation = rad_from_deg(2.0 + 4.4 * row);
      ScannedTarget target;
      target.kind = static_cast<TargetKind>(hung.size() % 3);
      target.radius_m = target.kind == TargetKind::sphere     ? sphere_radius_m
                        : target.kind == TargetKind::quarters ? board_radius_m
                                                              : coded_radius_m;
      target.code = code_of_id(static_cast<int>(hung.size()) + 1);
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const double towards = random.uniform(k++, 0.0, 2.0 * pi), tilt = rad_from_deg(random.uniform(k++, 0.0, 40.0)),
                   turn = random.uniform(k++, 0.0, 2.0 * pi);
      Pose pose = Pose::Identity();
      pose.linear() = (Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), -ray) *
                       Eigen::AngleAxisd(tilt, Eigen::Vector3d(std::cos(towards), std::sin(towards), 0.0)) *
                       Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))
                          .toRotationMatrix();
      pose.translation() = range_m * ray;
      target.pose = site_from_scan * pose;
      hung.push_back(target);
    }
  return hung;
}

void bench_spacing(const RockTunnel& tunnel, double step_mrad, int scans) {
  constexpr double half_deg = 12.0;
  std::map<TargetKind, Row> rows;
  Progress progress;
  for (int i = 0; i < scans; ++i) {
    const Random random(static_cast<std::uint64_t>(i + 1), 77);
    Pose site_from_scan = camera_in(tunnel, 20.0 + i, 0.0, 1.7, {0.0, 0.0, 0.0});
    Eigen::Matrix3d camera_from_scan;  // x forward, y left, z up
    camera_from_scan << 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0;
    site_from_scan.linear() *= camera_from_scan;
    ScannerOptions options;
    options.seed = static_cast<std::uint64_t>(i + 1);
    options.from_azimuth_deg = -half_deg;
    options.to_azimuth_deg = half_deg;
    options.lowest_elevation_deg = 2.0 - half_deg;
    options.highest_elevation_deg = 2.0 + half_deg;
    options.pulses = static_cast<std::uint64_t>(std::pow(rad_from_deg(2.0 * half_deg) / (1e-3 * step_mrad), 2));
    options.targets = hung_before(site_from_scan, random);
    const CloudTiles tiles(scan_tunnel(tunnel, site_from_scan, options, {}, progress));
    ScanTargetOptions find;
    find.sphere_radius_m = sphere_radius_m;
    find.quarters = find.coded = true;
    const std::vector<ScanTarget> found = find_scan_targets(tiles, find, progress);
    std::vector<bool> hit(found.size(), false);
    for (const ScannedTarget& target : options.targets) {
      Row& row = rows[target.kind];
      ++row.hung;
      for (std::size_t n = 0; n < found.size(); ++n) {
        const Eigen::Vector3d off = site_from_scan * found[n].center - target.pose.translation();
        if (found[n].kind != target.kind || off.norm() > 0.05) continue;
        hit[n] = true;
        if (target.kind == TargetKind::coded && found[n].code_id != id_of_code(target.code)) {
          ++row.wrong;
          continue;
        }
        ++row.found;
        row.within += off.norm() < 0.001 ? 1 : 0;
        row.squares += off.squaredNorm();
        row.normalised += off.squaredNorm() / (found[n].sigma_m * found[n].sigma_m);
        row.worst_m = std::max(row.worst_m, off.norm());
      }
    }
    for (std::size_t n = 0; n < found.size(); ++n) rows[found[n].kind].wrong += hit[n] ? 0 : 1;
  }
  for (const auto& [kind, row] : rows) {
    const char* const names[] = {"spheres of 145 mm", "quarters of 200 mm", "coded, 150 mm"};
    const double n = std::max(1, row.found);
    std::printf("| %.0f mm | %s | %d of %d | %d | %.0f %% | %.2f mm | %.2f mm | %.2f |\n", 10.0 * step_mrad,
                names[static_cast<int>(kind)], row.found, row.hung, row.wrong, 100.0 * row.within / n,
                1e3 * std::sqrt(row.squares / n), 1e3 * row.worst_m, std::sqrt(row.normalised / (3.0 * n)));
  }
}

}  // namespace

void bench_scan_targets() {
  std::printf(
      "\n### Targets in scans\n\n8.5 to 10.3 m away, up to 40 degrees oblique and turned in any way; noise 2.5 mm, a beam of 5 mm and 0.3 mrad. Off the truth in space.\n\n"
      "| points at 10 m | target | found | invented or wrong | within 1 mm | off, rms | worst | off over sigma |\n|---|---|---|---|---|---|---|---|\n");
  const RockTunnel tunnel = picture_tunnel(1);
  bench_spacing(tunnel, 0.3, 4);
  bench_spacing(tunnel, 0.6, 8);
  bench_spacing(tunnel, 0.9, 4);
}

}  // namespace adit::bench
