// From points to sections and volumes, and the surface.

#include <cstdio>

#include "core/geometry/voxel_grid.h"
#include "core/profiling/profiling.h"
#include "core/surface/reconstruct.h"
#include "tests/bench/bench.h"

namespace adit::bench {

void bench_profiling() {
  const RockTunnel rock = tests::sample_rock();
  Progress progress;
  std::vector<PlacedTiles> scans;
  std::vector<Eigen::Vector3d> points, viewpoints;
  std::uint64_t total = 0;
  double scanning = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Pose pose = tests::station(rock.design(), 30.0 + 11.0 * i, 70.0 * i);
    PointCloud cloud;
    scanning += seconds_of(1, [&] { cloud = tests::scan_at(rock, pose, 30 + static_cast<std::uint64_t>(i), 1000000); });
    total += cloud.size();
    viewpoints.push_back(pose.translation());
    for (const auto& p : even_subsample(cloud, 0.15).points) points.push_back(pose * p.cast<double>());
    scans.push_back({"S", std::make_shared<CloudTiles>(std::move(cloud)), pose});
  }
  MapResult map;
  const double mapping = seconds_of(2, [&] { map = map_deviations(scans, rock.design(), 28.0, 54.0, {}, progress); });
  const auto chainages = section_chainages(28.0, 54.0, 0.1);
  const double cutting = seconds_of(2, [&] {
    for (const double s : chainages) cut_section(map.map, rock.design(), s, {});
  });
  Volume volume;
  const double integrating = seconds_of(2, [&] {
    volume = compute_volume(map.map, rock.design(), {"excavation", 0.0}, 28.0, 54.0, 1.0, {}, {}, progress);
  });
  const VolumeAmounts truth = true_volume(rock, 28.0, 54.0, progress);
  const double meshing = seconds_of(1, [&] { reconstruct(points, viewpoints, {}, progress); });
  std::printf(
      "\n### From points to volumes\n\nThree simulated scans, %.2f million points, 26 m of tunnel, slices and cells of 0.1 m.\n\n",
      static_cast<double>(total) / 1e6);
  std::printf("| part | result |\n|---|---|\n");
  std::printf("| simulating the scans | %.2f million pulses/s |\n", 3.0 / scanning);
  std::printf("| deviation map | %.2f million points/s |\n", static_cast<double>(total) / 1e6 / mapping);
  std::printf("| one section out of the map, two lines | %.2f ms |\n",
              1e3 * cutting / static_cast<double>(chainages.size()));
  std::printf("| volumes of one line with two other methods and sigma | %.2f s |\n", integrating);
  std::printf("| surface (advancing front, CGAL) | %.0f points/s |\n", static_cast<double>(points.size()) / meshing);
  std::printf("| error of overbreak | %+.3f %% (average end area %+.3f %%, prismoidal %+.3f %%) |\n",
              100.0 * (volume.slices.overbreak_m3 / truth.overbreak_m3 - 1.0),
              100.0 * (volume.average_end_area.overbreak_m3 / truth.overbreak_m3 - 1.0),
              100.0 * (volume.prismoidal.overbreak_m3 / truth.overbreak_m3 - 1.0));
  std::printf("| error of excavated volume | %+.4f %% |\n",
              100.0 * (volume.slices.excavated_m3 / truth.excavated_m3 - 1.0));
}

}  // namespace adit::bench
