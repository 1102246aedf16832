// A simulated pair 8 m apart, guesses 0.5 m and 2 degrees off: PCL's engines alone and what the register step does.

#include <cstdio>

#include "core/foundation/random.h"
#include "core/geometry/statistics.h"
#include "core/registration/ndt.h"
#include "core/registration/register_pair.h"
#include "tests/bench/bench.h"
#include "tests/bench/pcl_icp.h"
#include "tests/bench/pcl_ndt.h"

namespace adit::bench {
namespace {

constexpr int trials = 10;

struct Pair {
  RockTunnel rock = tests::sample_rock();
  Pose first = tests::station(rock.design(), 36.0, 10.0);
  Pose second = tests::station(rock.design(), 44.0, 140.0);
  PreparedScan target, source;

  Pair() {
    Progress progress;
    target = prepare_scan("A", CloudTiles(tests::scan_at(rock, first, 1, 900000)), 0.1, 0.6, 45.0, progress);
    source = prepare_scan("B", CloudTiles(tests::scan_at(rock, second, 2, 900000)), 0.1, 0.6, 45.0, progress);
  }
};

using Engine = Pose (*)(const Pair&, const Pose&);

Pose pcl_ndt(const Pair& pair, const Pose& guess) {
  Progress progress;
  return pcl_ndt_align(pair.target, pair.source, guess, {}, progress);
}

Pose pcl_ndt_icp(const Pair& pair, const Pose& guess) {
  Progress progress;
  return pcl_icp_align(pair.target, pair.source, pcl_ndt_align(pair.target, pair.source, guess, {}, progress), {},
                       progress);
}

Pose adit_ndt(const Pair& pair, const Pose& guess) {
  Progress progress;
  return ndt_align(pair.target.pyramid, pair.source.pyramid, guess, {}, progress).target_from_source;
}

Pose adit_pair(const Pair& pair, const Pose& guess) {
  Progress progress;
  const Eigen::Vector2d t = pair.rock.design().alignment().horizontal().at(40.0).tangent();
  const Eigen::Vector3d axis = pair.first.linear().transpose() * Eigen::Vector3d(t.x(), t.y(), 0.0);
  return register_pair(pair.target, pair.source, guess, axis, {}, progress).target_from_source;
}

void row(const char* name, const Pair& pair, Engine engine) {
  const Pose truth = pair.first.inverse() * pair.second;
  const Random random(17);
  std::vector<double> millimetres, degrees, seconds;
  for (std::uint64_t i = 0; i < trials; ++i) {
    const Eigen::Vector3d direction(random.normal(6 * i), random.normal(6 * i + 1), 0.3 * random.normal(6 * i + 2));
    const Pose guess = tests::off(truth, 0.5 * direction.normalized(), i % 2 == 0 ? 2.0 : -2.0);
    Pose found;
    seconds.push_back(seconds_of(1, [&] { found = engine(pair, guess); }));
    millimetres.push_back(1e3 * distance_between_m(found, truth));
    degrees.push_back(deg_from_rad(rotation_between_rad(found, truth)));
  }
  std::printf("| %s | %.2f | %.2f | %.4f | %.2f |\n", name, median(millimetres), quantile(millimetres, 1.0),
              quantile(degrees, 1.0), median(seconds));
}

}  // namespace

void bench_registration() {
  const Pair pair;
  std::printf(
      "\n### Registration of a pair\n\nTwo simulated scans of 900,000 pulses 8 m apart, thinned to 0.1 m (%zu and %zu points), %d starts 0.5 m and "
      "2 degrees off.\n\n",
      pair.target.points.size(), pair.source.points.size(), trials);
  std::printf("| engine | median error mm | worst mm | worst degrees | median s |\n|---|---|---|---|---|\n");
  row("PCL NDT", pair, pcl_ndt);
  row("PCL NDT, PCL ICP point to plane", pair, pcl_ndt_icp);
  row("ndt_align", pair, adit_ndt);
  row("register_pair (NDT, then robust point to plane)", pair, adit_pair);
}

}  // namespace adit::bench
