// Reading and writing a scan of one million points: ours and PCL's on the same files.

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cstdio>

#include "io/point_store.h"
#include "io/scan_formats.h"
#include "io/store_writer.h"
#include "tests/bench/bench.h"
#include "tests/temporary_folder.h"

namespace adit::bench {

void bench_io() {
  const tests::TemporaryFolder folder;
  const RockTunnel rock = tests::sample_rock();
  Progress progress;
  io::ScanData scan;
  scan.name = "S";
  scan.cloud = tests::scan_at(rock, tests::station(rock.design(), 36.0, 0.0), 1, 1000000);
  const double millions = static_cast<double>(scan.cloud.size()) / 1e6;
  std::printf(
      "\n### Files of %.2f million points\n\n| file | write Mpts/s | read Mpts/s | PCL reads Mpts/s |\n|---|---|---|---|\n",
      millions);
  for (const char* name : {"a.ply", "a.pcd", "a.las", "a.pts", "a.ptx", "a.xyz"}) {
    const auto file = folder / name;
    const double write = seconds_of(3, [&] { io::write_scans(file, {scan}, {}, progress); });
    const double read = seconds_of(3, [&] { io::read_scans(file, {}, progress); });
    char peer[32] = "-";
    pcl::PointCloud<pcl::PointXYZI> cloud;
    if (std::string(name) == "a.ply")
      std::snprintf(peer, sizeof peer, "%.1f",
                    millions / seconds_of(3, [&] { pcl::io::loadPLYFile(file.string(), cloud); }));
    if (std::string(name) == "a.pcd")
      std::snprintf(peer, sizeof peer, "%.1f",
                    millions / seconds_of(3, [&] { pcl::io::loadPCDFile(file.string(), cloud); }));
    std::printf("| %s | %.1f | %.1f | %s |\n", name + 2, millions / write, millions / read, peer);
  }
  const auto store = folder / "a.points";
  const double write = seconds_of(3, [&] { io::write_point_store(store, scan, {}, progress); });
  const double read = seconds_of(3, [&] {
    const io::PointStore points(store);
    for (std::size_t t = 0; t < points.tile_count(); ++t) points.read(t);
  });
  std::printf("| point store | %.1f | %.1f | - |\n", millions / write, millions / read);
}

}  // namespace adit::bench
