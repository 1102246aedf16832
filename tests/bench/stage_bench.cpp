// Which stages of iterative closest point serve tunnels best? One stage changed at a time.

#include <cstdio>

#include "core/geometry/statistics.h"
#include "core/registration/ndt.h"
#include "core/registration/pair_refinement.h"
#include "tests/bench/bench.h"
#include "tests/bench/simulated_pair.h"

namespace adit::bench {
namespace {

struct Case {
  PreparedScan target, source;
  Pose start = Pose::Identity();  ///< where the transform ends
  SimulatedPair pair;
};

Case prepared_case(std::uint64_t seed) {
  Case made;
  made.pair = simulated_pair(seed);
  Progress progress;
  made.target = prepare_scan("target", CloudTiles(made.pair.target), 0.1, 0.6, 45.0, progress);
  made.source = prepare_scan("source", CloudTiles(made.pair.source), 0.1, 0.6, 45.0, progress);
  NdtOptions ndt;
  ndt.finest_cell_m = 0.8;
  ndt.search_m = 0.0;
  made.start = ndt_align(made.target.pyramid, made.source.pyramid, made.pair.truth, ndt, progress).target_from_source;
  return made;
}

void row(const char* name, const std::vector<Case>& cases, const RegistrationOptions& options) {
  std::vector<double> millimetres, degrees, seconds;
  for (const Case& c : cases) {
    Pose found;
    Progress progress;
    const Eigen::Matrix3d axes = tunnel_axes(c.pair.axis);
    seconds.push_back(
        seconds_of(1, [&] { found = refined(c.target, c.source, c.start, {}, axes, options, progress); }));
    millimetres.push_back(1e3 * distance_between_m(found, c.pair.truth));
    degrees.push_back(deg_from_rad(rotation_between_rad(found, c.pair.truth)));
  }
  std::printf("| %s | %.2f | %.2f | %.4f | %.2f |\n", name, median(millimetres), quantile(millimetres, 1.0),
              quantile(degrees, 1.0), median(seconds));
  std::fflush(stdout);
}

}  // namespace

void bench_stages() {
  std::vector<Case> cases;
  for (std::uint64_t seed = 1; seed <= simulated_pairs; ++seed) cases.push_back(prepared_case(seed));
  std::vector<double> before;
  for (const Case& c : cases) before.push_back(1e3 * distance_between_m(c.start, c.pair.truth));
  std::printf(
      "\n### Stages of iterative closest point\n\n%d simulated pairs, pieces of 0.1 m, from where the transform ends "
      "(%.1f to %.1f mm off). The basis: all points, nearest, constant weights, 0.3 m, rims and normals over 45 "
      "degrees rejected, plane to plane.\n\n| stages | median mm | worst mm | worst degrees | s |\n"
      "|---|---|---|---|---|\n",
      simulated_pairs, quantile(before, 0.0), quantile(before, 1.0));
  RegistrationOptions options;
  row("surfaces (the register step's default)", cases, options);
  options.refinement = Refinement::points;
  row("basis", cases, options);
  const auto with = [&](const char* name, const auto& change) {
    RegistrationOptions changed = options;
    change(changed.icp);
    row(name, cases, changed);
  };
  with("selection: uniform 10,000", [](IcpOptions& o) { o.selection = IcpSelection::uniform, o.samples = 10000; });
  with("selection: random 10,000", [](IcpOptions& o) { o.selection = IcpSelection::random, o.samples = 10000; });
  with("selection: normal space 10,000",
       [](IcpOptions& o) { o.selection = IcpSelection::normal_space, o.samples = 10000; });
  with("matching: normal shooting", [](IcpOptions& o) { o.matching = IcpMatching::normal_shooting; });
  with("matching: projection", [](IcpOptions& o) { o.matching = IcpMatching::projection; });
  with("weights: distance", [](IcpOptions& o) { o.weights = IcpWeights::distance; });
  with("weights: normals", [](IcpOptions& o) { o.weights = IcpWeights::normals; });
  with("weights: range", [](IcpOptions& o) { o.weights = IcpWeights::range; });
  with("rejection: falling reach", [](IcpOptions& o) { o.reach_falls = true; });
  with("rejection: rims kept", [](IcpOptions& o) { o.boundary_rejected = false; });
  with("rejection: any normals", [](IcpOptions& o) { o.most_normals_deg = 90.0; });
  with("rejection: best 80 %", [](IcpOptions& o) { o.best_share = 0.8; });
  with("rejection: 0.1 m", [](IcpOptions& o) { o.reach_m = 0.1; });
  with("metric: point to point", [](IcpOptions& o) { o.metric = IcpMetric::point_to_point; });
  with("metric: point to plane", [](IcpOptions& o) { o.metric = IcpMetric::point_to_plane; });
}

}  // namespace adit::bench
