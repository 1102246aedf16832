// Fifty simulated tunnels, no guess for any scan: how many are placed, and is every stated sigma true?

#include <array>
#include <cstdio>
#include <numeric>

#include "core/foundation/random.h"
#include "core/registration/observability.h"
#include "tests/bench/bench.h"
#include "tests/core/sample_mine.h"

namespace adit::bench {
namespace {

constexpr std::uint64_t mines = 50;
constexpr std::uint64_t pulses = 150000;

/// Errors over sigmas, by direction. The root mean square of the quotients is 1 where sigmas are neither too small nor
/// too large.
struct Honesty {
  std::array<std::size_t, 6> inside{};
  std::array<double, 6> squares{};
  std::size_t all = 0;

  void add(const Pose& found, const Pose& truth, const Eigen::Matrix3d& axes, const PoseSigma& sigma) {
    const Eigen::Vector3d move = axes * (found.translation() - truth.translation());
    const Eigen::Vector3d turn = axes * rotation_vector(found.linear() * truth.linear().transpose());
    const double errors[] = {move.x(), move.y(), move.z(), turn.x(), turn.y(), turn.z()};
    const double sigmas[] = {sigma.along_m, sigma.across_m, sigma.up_m, sigma.roll_rad, sigma.pitch_rad, sigma.yaw_rad};
    for (std::size_t i = 0; i < 6; ++i) {
      inside[i] += std::abs(errors[i]) <= 2.0 * sigmas[i];
      squares[i] += errors[i] * errors[i] / (sigmas[i] * sigmas[i]);
    }
    ++all;
  }
  void print(const char* what) const {
    std::printf("| %s | %zu |", what, all);
    const auto n = static_cast<double>(std::max<std::size_t>(1, all));
    for (std::size_t i = 0; i < 6; ++i)
      std::printf(" %.1f %%, %.2f |", 100.0 * static_cast<double>(inside[i]) / n, std::sqrt(squares[i] / n));
    std::printf("\n");
  }
};

struct Tally {
  std::size_t scans = 0, placed = 0, wrong = 0;
  double worst_mm = 0.0, worst_deg = 0.0;
};

std::vector<std::size_t> shuffled(std::size_t n, std::uint64_t seed) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const Random random(seed, 71);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.bits(i) % i]);
  return order;
}

Eigen::Matrix3d axes_at(const tests::SampleMine& mine, const Pose& station) {
  return tunnel_axes(
      tests::context_along(mine.tunnels.front().design().alignment()).axis_direction(station.translation()));
}

}  // namespace

void bench_placement() {
  std::printf(
      "\n### Hands-free placement\n\nNo guesses, scans in random order, any yaw, every other mine tilted by up to 5 degrees; "
      "%llu pulses a scan. Right: within 20 mm and 0.1 degrees.\n\n",
      static_cast<unsigned long long>(pulses));
  std::printf(
      "| seed | mine | scans | placed | wrong | worst mm | worst degrees | s |\n|---|---|---|---|---|---|---|---|\n");
  Tally total;
  Honesty of_pairs, of_scans;
  for (std::uint64_t seed = 1; seed <= mines; ++seed) {
    const auto kind = static_cast<tests::MineKind>(seed % 4);
    const int stations = 4 + static_cast<int>(seed % 7);
    const tests::SampleMine mine = tests::sample_mine(kind, seed, stations);
    const std::vector<std::size_t> order = shuffled(mine.stations.size(), seed);
    std::vector<ScanToPlace> scans;
    std::vector<Pose> truth;
    for (const std::size_t i : order) {
      ScannerOptions scanner;
      scanner.seed = 100 * seed + i;
      scanner.pulses = pulses;
      Progress progress;
      scans.push_back(tests::scan_to_place("S" + std::to_string(i),
                                           scan_tunnel(mine.tunnels, mine.stations[i], scanner, {}, progress),
                                           Pose::Identity()));
      scans.back().local_from_scan_guess.reset();
      truth.push_back(mine.stations[i]);
    }
    RegistrationResult result;
    const double seconds = seconds_of(1, [&] {
      Progress progress;
      result = register_scans(scans, {}, {}, progress);
    });
    Tally tally;
    tally.scans = scans.size();
    std::size_t datum = 0;
    while (datum < scans.size() && result.scans[datum].placed_by != "datum") ++datum;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      if (!result.scans[i].placed) continue;
      ++tally.placed;
      const Pose right = truth[datum].inverse() * truth[i];
      const double mm = 1e3 * distance_between_m(right, result.scans[i].local_from_scan);
      const double deg = deg_from_rad(rotation_between_rad(right, result.scans[i].local_from_scan));
      tally.wrong += mm > 20.0 || deg > 0.1;
      tally.worst_mm = std::max(tally.worst_mm, mm);
      tally.worst_deg = std::max(tally.worst_deg, deg);
    }
    for (const PairResult& pair : result.pairs) {
      const auto index = [&](const std::string& name) {
        return std::find_if(scans.begin(), scans.end(), [&](const auto& s) { return s.name == name; }) - scans.begin();
      };
      const Pose& target = truth[static_cast<std::size_t>(index(pair.target))];
      const Pose& source = truth[static_cast<std::size_t>(index(pair.source))];
      if (!pair.used || !pair.undetermined.empty()) continue;
      of_pairs.add(pair.target_from_source, target.inverse() * source, axes_at(mine, target) * target.linear(),
                   pair.sigma);
    }
    for (std::size_t i = 0; i < scans.size(); ++i)
      if (result.scans[i].placed && i != datum)
        of_scans.add(result.scans[i].local_from_scan, truth[datum].inverse() * truth[i],
                     axes_at(mine, truth[i]) * truth[datum].linear(), result.scans[i].sigma);
    std::printf("| %llu | %s | %zu | %zu | %zu | %.2f | %.4f | %.1f |\n", static_cast<unsigned long long>(seed),
                name_of(kind), tally.scans, tally.placed, tally.wrong, tally.worst_mm, tally.worst_deg, seconds);
    std::fflush(stdout);
    total.scans += tally.scans;
    total.placed += tally.placed;
    total.wrong += tally.wrong;
  }
  std::printf(
      "\nAll: %zu scans, %zu placed (%.1f %%), %zu wrong.\n\nWithin two stated sigmas, and the root mean square of errors over sigmas:\n\n"
      "| of | number | along | across | up | roll | pitch | yaw |\n|---|---|---|---|---|---|---|---|\n",
      total.scans, total.placed, 100.0 * static_cast<double>(total.placed) / static_cast<double>(total.scans),
      total.wrong);
  of_pairs.print("pairs");
  of_scans.print("scans");
}

}  // namespace adit::bench
