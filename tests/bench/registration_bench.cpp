// Simulated pairs 8 m apart: PCL's engines as users call them and what the register step does, whole jobs on one
// thread.

#include <tbb/global_control.h>
#include <tbb/parallel_invoke.h>

#include <cstdio>

#include "core/foundation/random.h"
#include "core/geometry/statistics.h"
#include "core/registration/ndt.h"
#include "core/registration/scan_pairs.h"
#include "tests/bench/bench.h"
#include "tests/bench/pcl_peers.h"
#include "tests/bench/simulated_pair.h"

namespace adit::bench {
namespace {

constexpr std::uint64_t trials = 100;
constexpr std::uint64_t peer_trials = 20;

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
  PreparedScan target, source;
  tbb::parallel_invoke([&] { target = prepared(pair.target); }, [&] { source = prepared(pair.source); });
  return matched_pair(target, source, guess, Start::guess, pair.axis, {}, progress).target_from_source;
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
         const std::vector<SimulatedPair>& all) {
  Row row;
  for (std::uint64_t i = 0; i < runs; ++i) {
    const std::size_t which = i % simulated_pairs;
    Pose found;
    const double seconds = seconds_of(1, [&] { found = engine(which, start_of(all[which].truth, i, off_m, off_deg)); });
    row.add(found, all[which].truth, seconds);
  }
  char start[40];
  std::snprintf(start, sizeof start, "%.0f m, %.0f deg", off_m, off_deg);
  row.print(name, start);
}

/// In turn, so that all meet the machine in the same states.
void ratios(const std::vector<SimulatedPair>& all, const std::vector<Ours>& ours) {
  std::vector<double> gicp_s, one_s, two_s, to_gicp, to_one;
  const auto on_threads = [](std::size_t threads, const auto& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return seconds_of(1, work);
  };
  for (std::uint64_t i = 0; i < peer_trials; ++i) {
    const SimulatedPair& pair = all[i % simulated_pairs];
    const Ours& our = ours[i % simulated_pairs];
    const Pose start = start_of(pair.truth, i, 1.0, 2.0);
    gicp_s.push_back(on_threads(1, [&] { pcl_gicp(pair.target.points, pair.source.points, start); }));
    one_s.push_back(on_threads(1, [&] { adit_pair(our, start); }));
    two_s.push_back(on_threads(2, [&] { adit_pair(our, start); }));
    to_gicp.push_back(one_s.back() / gicp_s.back());
    to_one.push_back(two_s.back() / one_s.back());
  }
  std::printf(
      "\nIn turn, 1 m and 2 degrees, medians of %llu: PCL GICP %.3f s, Adit matched_pair %.3f s (%.2f of it), on 2 threads "
      "%.3f s (%.2f of one).\n",
      static_cast<unsigned long long>(peer_trials), median(gicp_s), median(one_s), median(to_gicp), median(two_s),
      median(to_one));
}

}  // namespace

void bench_registration() {
  std::vector<SimulatedPair> all;
  std::vector<Ours> ours;
  for (std::uint64_t seed = 1; seed <= simulated_pairs; ++seed) {
    all.push_back(simulated_pair(seed));
    ours.push_back({CloudTiles(all.back().target), CloudTiles(all.back().source), all.back().axis});
  }
  std::printf(
      "\n### Registration of a pair\n\n%d simulated pairs of 900,000 pulses, 8 m apart, 5 mm noise at square incidence. Whole jobs, preparation "
      "and all, on one thread (where not said otherwise). Good: within 2 mm and 0.01 degrees.\n\n",
      simulated_pairs);
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
    row("Adit matched_pair", trials, 1.0, 2.0, our(adit_pair), all);
    row("PCL GICP", peer_trials, 3.0, 10.0, peer(pcl_gicp), all);
    row("PCL NDT", peer_trials, 3.0, 10.0, peer(pcl_ndt), all);
    row("Adit matched_pair", trials, 3.0, 10.0, our(adit_pair), all);
  }
  ratios(all, ours);
}

}  // namespace adit::bench
