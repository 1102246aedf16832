// Simulated pairs 8 m apart: PCL's engines as users call them and what the register step does, whole jobs on one
// thread.

#include <tbb/global_control.h>

#include <cstdio>

#include "core/foundation/random.h"
#include "core/geometry/statistics.h"
#include "core/registration/ndt.h"
#include "core/registration/register_pair.h"
#include "tests/bench/bench.h"
#include "tests/bench/pcl_peers.h"
#include "tests/core/sample_mine.h"

namespace adit::bench {
namespace {

constexpr int pairs = 5;
constexpr std::uint64_t trials = 100;
constexpr std::uint64_t peer_trials = 20;

struct Pair {
  PointCloud target, source;
  Pose truth = Pose::Identity();  ///< target_from_source
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
};

Pair simulated_pair(std::uint64_t seed) {
  const auto kind = seed % 2 == 0 ? tests::MineKind::straight : tests::MineKind::curved;
  const tests::SampleMine mine = tests::sample_mine(kind, seed, 3);
  const Alignment& axis = mine.tunnels.front().design().alignment();
  const double at_m = axis.to_tunnel(mine.stations.front().translation())->s_m;
  const Pose first = mine.stations.front();
  const Pose second = tests::mine_station(axis, at_m + 8.0, Random(seed, 3), 1, 2.0);
  ScannerOptions scanner;
  scanner.pulses = 900000;
  scanner.range_sigma_m = 0.005;
  Progress progress;
  Pair pair;
  scanner.seed = 100 * seed;
  pair.target = scan_tunnel(mine.tunnels, first, scanner, {}, progress);
  scanner.seed = 100 * seed + 1;
  pair.source = scan_tunnel(mine.tunnels, second, scanner, {}, progress);
  pair.truth = first.inverse() * second;
  const Eigen::Vector2d t = axis.horizontal().at(at_m).tangent();
  pair.axis = first.linear().transpose() * Eigen::Vector3d(t.x(), t.y(), 0.0);
  return pair;
}

/// What is asked of our engines: as the register step does it, from points in tiles.
struct Ours {
  CloudTiles target, source;
  Eigen::Vector3d axis;
};

PreparedScan prepared(const CloudTiles& tiles) {
  Progress progress;
  return prepare_scan("scan", tiles, 0.1, 0.6, 45.0, progress);
}

Pose adit_ndt(const Ours& pair, const Pose& guess) {
  Progress progress;
  return ndt_align(prepared(pair.target).pyramid, prepared(pair.source).pyramid, guess, {}, progress)
      .target_from_source;
}

Pose adit_pair(const Ours& pair, const Pose& guess) {
  Progress progress;
  return register_pair(prepared(pair.target), prepared(pair.source), guess, Start::guess, pair.axis, {}, progress)
      .target_from_source;
}

struct Row {
  std::vector<double> millimetres, degrees, seconds;
  void add(const Pose& found, const Pose& truth, double s) {
    millimetres.push_back(1e3 * distance_between_m(found, truth));
    degrees.push_back(deg_from_rad(rotation_between_rad(found, truth)));
    seconds.push_back(s);
  }
  void print(const char* name, const char* start) const {
    std::size_t good = 0;
    for (std::size_t i = 0; i < millimetres.size(); ++i) good += millimetres[i] < 2.0 && degrees[i] < 0.01;
    std::printf("| %s | %s | %zu of %zu | %.3f | %.2f | %.4f | %.3f |\n", name, start, good, millimetres.size(),
                median(millimetres), quantile(millimetres, 1.0), quantile(degrees, 1.0), median(seconds));
    std::fflush(stdout);
  }
};

Pose start_of(const Pose& truth, std::uint64_t trial, double off_m, double off_deg) {
  const Random random(17, trial);
  const Eigen::Vector3d direction(random.normal(0), random.normal(1), 0.3 * random.normal(2));
  return tests::off(truth, off_m * direction.normalized(), trial % 2 == 0 ? off_deg : -off_deg);
}

template <typename Engine>
void row(const char* name, std::uint64_t runs, double off_m, double off_deg, const Engine& engine,
         const std::vector<Pair>& all) {
  Row row;
  for (std::uint64_t i = 0; i < runs; ++i) {
    const std::size_t which = i % pairs;
    Pose found;
    const double seconds = seconds_of(1, [&] { found = engine(which, start_of(all[which].truth, i, off_m, off_deg)); });
    row.add(found, all[which].truth, seconds);
  }
  char start[40];
  std::snprintf(start, sizeof start, "%.0f m, %.0f deg", off_m, off_deg);
  row.print(name, start);
}

}  // namespace

void bench_registration() {
  std::vector<Pair> all;
  std::vector<Ours> ours;
  for (std::uint64_t seed = 1; seed <= pairs; ++seed) {
    all.push_back(simulated_pair(seed));
    ours.push_back({CloudTiles(all.back().target), CloudTiles(all.back().source), all.back().axis});
  }
  std::printf(
      "\n### Registration of a pair\n\n%d simulated pairs of 900,000 pulses, 8 m apart, 5 mm noise at square incidence. Whole jobs, preparation "
      "and all, on one thread (where not said otherwise). Good: within 2 mm and 0.01 degrees.\n\n",
      pairs);
  std::printf(
      "| engine | start | good | median error mm | worst mm | worst degrees | median s |\n"
      "|---|---|---|---|---|---|---|\n");
  const auto peer = [&](auto engine) {
    return [&all, engine](std::size_t i, const Pose& guess) {
      return engine(all[i].target.points, all[i].source.points, guess);
    };
  };
  const auto our = [&](auto engine) {
    return [&ours, engine](std::size_t i, const Pose& guess) { return engine(ours[i], guess); };
  };
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    row("PCL GICP", peer_trials, 1.0, 2.0, peer(pcl_gicp), all);
    row("PCL NDT", peer_trials, 1.0, 2.0, peer(pcl_ndt), all);
    row("PCL ICP", peer_trials, 1.0, 2.0, peer(pcl_icp), all);
    row("PCL ICP point to plane", peer_trials, 1.0, 2.0, peer(pcl_icp_to_plane), all);
    row("Adit ndt_align", trials, 1.0, 2.0, our(adit_ndt), all);
    row("Adit register_pair", trials, 1.0, 2.0, our(adit_pair), all);
    row("PCL GICP", peer_trials, 3.0, 10.0, peer(pcl_gicp), all);
    row("PCL NDT", peer_trials, 3.0, 10.0, peer(pcl_ndt), all);
    row("Adit register_pair", trials, 3.0, 10.0, our(adit_pair), all);
  }
  row("Adit register_pair, 2 threads", peer_trials, 1.0, 2.0, our(adit_pair), all);
}

}  // namespace adit::bench
