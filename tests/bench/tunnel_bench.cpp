// Long chains of stations with control at their ends, and linings that tell nothing along themselves.

#include <cstdio>

#include "core/foundation/random.h"
#include "core/registration/observability.h"
#include "tests/bench/bench.h"
#include "tests/core/sample_mine.h"

namespace adit::bench {
namespace {

constexpr std::uint64_t pulses = 150000;

struct Survey {
  tests::SampleMine mine;
  std::vector<ScanToPlace> scans;
  RegistrationContext context;
};

Pose guess_of(const Pose& truth, std::uint64_t seed, std::uint64_t i, double off_m, double off_deg) {
  const Random random(seed, 600 + i);
  const Eigen::Vector3d direction(random.normal(0), random.normal(1), 0.3 * random.normal(2));
  return tests::off(truth, off_m * direction.normalized(), random.uniform(3) < 0.5 ? -off_deg : off_deg);
}

void scan_all(Survey& survey, std::uint64_t seed, double off_m, double off_deg) {
  for (std::size_t i = 0; i < survey.mine.stations.size(); ++i) {
    ScannerOptions scanner;
    scanner.seed = 1000 * seed + i;
    scanner.pulses = pulses;
    Progress progress;
    const Pose& truth = survey.mine.stations[i];
    survey.scans.push_back(tests::scan_to_place("S" + std::to_string(i),
                                                scan_tunnel(survey.mine.tunnels, truth, scanner, {}, progress),
                                                guess_of(truth, seed, i, off_m, off_deg)));
  }
}

/// Four targets around a station, 1 mm noise in the scan and 0.7 mm in the control.
void add_targets(Survey& survey, std::size_t station) {
  const Random random(99, station);
  const Pose& pose = survey.mine.stations[station];
  const Eigen::Vector3d places[] = {{4, 3, 0.5}, {-4, 3, 1.5}, {3, -4, 2.0}, {-4, -3, -0.5}};
  for (std::uint64_t k = 0; k < 4; ++k) {
    const auto noise = [&](std::uint64_t n) {
      return Eigen::Vector3d(random.normal(9 * k + n), random.normal(9 * k + n + 1), random.normal(9 * k + n + 2));
    };
    const std::string id = "T" + std::to_string(station) + "." + std::to_string(k);
    survey.context.control.push_back({id, pose * places[k] + 0.0007 * noise(0)});
    survey.context.targets.push_back({"S" + std::to_string(station), id, places[k] + 0.001 * noise(3)});
  }
}

void chain_row(const Survey& survey, const char* control) {
  RegistrationResult result;
  const double seconds = seconds_of(1, [&] {
    Progress progress;
    result = register_scans(survey.scans, survey.context, {}, progress);
  });
  double worst_m = 0.0;
  std::size_t inside = 0;
  std::size_t all = 0;
  for (std::size_t i = 0; i < survey.scans.size(); ++i) {
    const PlacedScan& scan = result.scans[i];
    const Pose& truth = survey.mine.stations[i];
    worst_m = std::max(worst_m, distance_between_m(scan.local_from_scan, truth));
    const Eigen::Vector3d error = tunnel_axes(survey.context.axis_direction(truth.translation())) *
                                  (scan.local_from_scan.translation() - truth.translation());
    const double sigmas[] = {scan.sigma.along_m, scan.sigma.across_m, scan.sigma.up_m};
    for (Eigen::Index k = 0; k < 3; ++k) inside += std::abs(error[k]) <= 2.0 * sigmas[k];
    all += 3;
  }
  double before_m = 0.0;
  double after_m = 0.0;
  for (const LoopClosure& loop : result.loops) {
    before_m = std::max(before_m, loop.before_m);
    after_m = std::max(after_m, loop.after_m);
  }
  std::printf("| %s | %zu | %.2f | %zu of %zu | %.2f | %.2f | %s | %.1f |\n", control, survey.scans.size(),
              1e3 * worst_m, inside, all, 1e3 * before_m, 1e3 * after_m, result.accepted ? "yes" : "no", seconds);
  std::fflush(stdout);
}

Survey chain_of_thirty() {
  Survey survey;
  constexpr int stations = 30;
  constexpr double apart_m = 8.6;
  const Alignment axis = tests::mine_axis({100, 200, 30}, 0.4, 290.0, 400.0, 0.02);
  survey.mine.tunnels.push_back(tests::mine_tunnel(axis, 285.0, 7, {}));
  for (int i = 0; i < stations; ++i)
    survey.mine.stations.push_back(
        tests::mine_station(axis, 12.0 + apart_m * i, Random(5), static_cast<std::uint64_t>(i), 0.5));
  survey.context = tests::context_along(axis);
  scan_all(survey, 5, 0.5, 2.0);
  return survey;
}

Survey smooth_pair(std::uint64_t seed) {
  RockTunnelOptions smooth;
  smooth.lookout_collar_m = smooth.lookout_toe_m = 0.1;
  smooth.roughness_sigma_m = smooth.floor_sigma_m = 0.0;
  smooth.clutter = false;
  Survey survey;
  const Alignment axis = tests::mine_axis({100, 200, 30}, 0.3 * static_cast<double>(seed), 210.0, 0.0, 0.01);
  survey.mine.tunnels.push_back(tests::mine_tunnel(axis, 200.0, seed, smooth));
  for (const double s : {90.0, 98.0})
    survey.mine.stations.push_back(tests::mine_station(axis, s, Random(seed), static_cast<std::uint64_t>(s), 0.5));
  survey.context = tests::context_along(axis);
  scan_all(survey, seed, 0.5, 1.0);
  survey.scans[0].local_from_scan_guess = survey.mine.stations[0];
  return survey;
}

}  // namespace

void bench_tunnels() {
  std::printf(
      "\n### Chains of stations\n\n250 m in a curve, 8.6 m apart, %llu pulses, guesses 0.5 m and 2 degrees off; four targets at each of two "
      "stations.\n\n| control | scans | worst mm | components in 2 sigma | loop before mm | after mm | accepted | s "
      "|\n|---|---|---|---|---|---|---|---|\n",
      static_cast<unsigned long long>(pulses));
  Survey chain = chain_of_thirty();
  add_targets(chain, 0);
  add_targets(chain, 1);
  chain_row(chain, "one end");
  add_targets(chain, 28);
  add_targets(chain, 29);
  chain_row(chain, "both ends");

  std::printf(
      "\n### A smooth lining without features\n\nTwo stations 8 m apart, guess 0.5 m and 1 degree off.\n\n"
      "| seed | undetermined | along off its guess mm | others mm | others degrees |\n|---|---|---|---|---|\n");
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Survey survey = smooth_pair(seed);
    Progress progress;
    const RegistrationResult result = register_scans(survey.scans, survey.context, {}, progress);
    const Pose& truth = survey.mine.stations[1];
    const Pose& found = result.scans[1].local_from_scan;
    const Eigen::Matrix3d axes = tunnel_axes(survey.context.axis_direction(truth.translation()));
    const Eigen::Vector3d error = axes * (found.translation() - truth.translation());
    const Eigen::Vector3d moved = axes * (found.translation() - survey.scans[1].local_from_scan_guess->translation());
    std::string names;
    for (const std::string& name : result.pairs.front().undetermined) names += (names.empty() ? "" : " ") + name;
    std::printf("| %llu | %s | %.1f | %.2f | %.4f |\n", static_cast<unsigned long long>(seed), names.c_str(),
                1e3 * moved.x(), 1e3 * error.tail<2>().norm(), deg_from_rad(rotation_between_rad(found, truth)));
    std::fflush(stdout);
  }
}

}  // namespace adit::bench
