// Reading and writing a scan of one million points: ours and PCL's on the same files.

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cstdio>

#include "io/point_store.h"
#include "io/scan_formats.h"
#include "io/store_writer.h"
#include "tests/bench/bench.h"
#include "tests/bench/library_loops.h"
#include "tests/temporary_folder.h"

namespace adit::bench {

namespace {

/// Every point decoded and handed on, nothing kept.
class Nowhere : public io::ScanSink {
 public:
  bool begin(const io::ScanHeader&) override { return true; }
  void take(io::PointBlock&) override {}
  void end(std::uint64_t) override {}
};

void bench_libraries(const io::ScanData& scan) {
  struct Row {
    const char* name;
    std::uint64_t (*decode)(const std::filesystem::path&);
  };
  const std::vector<Row> rows = {
#ifdef ADIT_BENCH_E57FORMAT
      {"a.e57", decode_e57},
#endif
#ifdef ADIT_BENCH_LASZIP
      {"a.laz", decode_laz},
#endif
  };
  const tests::TemporaryFolder folder;
  const double millions = static_cast<double>(scan.cloud.size()) / 1e6;
  Progress progress;
  std::printf("\n### Decoding of %.2f million points, beside the library alone\n\n", millions);
  std::printf("| file | bytes a point | write Mpts/s | stream Mpts/s | library Mpts/s | time against library |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    const auto file = folder / row.name;
    const double write = seconds_of(1, [&] { io::write_scans(file, {scan}, {}, progress); });
    Nowhere nowhere;
    const double ours = seconds_of(5, [&] { io::stream_scans(file, {}, nowhere, progress); });
    const double theirs = seconds_of(5, [&] { row.decode(file); });
    std::printf("| %s | %.1f | %.1f | %.2f | %.2f | %+.0f %% |\n", row.name + 2,
                static_cast<double>(std::filesystem::file_size(file)) / millions / 1e6, millions / write,
                millions / ours, millions / theirs, 100.0 * (ours / theirs - 1.0));
  }
}

}  // namespace

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
  scan.cloud = tests::scan_at(rock, tests::station(rock.design(), 36.0, 0.0), 1, 2000000);
  bench_libraries(scan);
}

}  // namespace adit::bench
