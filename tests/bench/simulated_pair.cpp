#include "tests/bench/simulated_pair.h"

#include "tests/core/sample_mine.h"

namespace adit::bench {

SimulatedPair simulated_pair(std::uint64_t seed) {
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
  SimulatedPair pair;
  scanner.seed = 100 * seed;
  pair.target = scan_tunnel(mine.tunnels, first, scanner, {}, progress);
  scanner.seed = 100 * seed + 1;
  pair.source = scan_tunnel(mine.tunnels, second, scanner, {}, progress);
  pair.truth = first.inverse() * second;
  const Eigen::Vector2d t = axis.horizontal().at(at_m).tangent();
  pair.axis = first.linear().transpose() * Eigen::Vector3d(t.x(), t.y(), 0.0);
  return pair;
}

}  // namespace adit::bench
