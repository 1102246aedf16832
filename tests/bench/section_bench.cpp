// Sections straight from the stored points of a job that has been registered.

#include <cstdio>

#include "app/placed_tiles.h"
#include "app/run_job.h"
#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "tests/bench/bench.h"

namespace adit::bench {

void bench_sections(const std::string& job) {
  Progress progress;
  app::RunOptions options;
  options.only_take_up = true;
  const auto state = app::run_job(job, options, progress);
  if (!state->design || state->results.registration.scans.empty())
    throw Error("the job is not registered or has no design", job, "run adit register first");
  const auto scans = app::placed_tiles(*state);
  std::uint64_t points = 0;
  for (const auto& store : state->stores) points += store->points();
  const JobChainage stretch = state->stretch();
  const double middle_m = 0.5 * (stretch.from_m + stretch.to_m);
  const ProfilingOptions& profiling = state->job.options.profiling;
  const double indexing = seconds_of(1, [&] { ChainageIndex(scans, state->design->alignment()); });
  const ChainageIndex index(scans, state->design->alignment());
  const auto cut = [&](double s) { return cut_section(scans, index, *state->design, s, profiling, progress); };
  const double first = seconds_of(1, [&] { cut(middle_m); });
  constexpr std::size_t many = 1000;
  const double thousand = seconds_of(1, [&] {
    parallel_for_each_index(
        many,
        [&](std::size_t i) {
          cut(stretch.from_m + (stretch.to_m - stretch.from_m) * (static_cast<double>(i) + 0.5) / many);
        },
        1);
  });
  std::printf("| %.1f | %.3f | %.3f | %.1f |\n", static_cast<double>(points) / 1e6, indexing, first, thousand);
}

void bench_slice(const std::string& job) {
  Progress progress;
  app::RunOptions options;
  options.last_step = "import";
  const auto state = app::run_job(job, options, progress);
  std::vector<PlacedTiles> scans;
  for (const auto& store : state->stores) scans.push_back({store->name(), store, Pose::Identity(), true});
  const BoundingBox slice(Eigen::Vector3d(2.0, -100.0, -100.0), Eigen::Vector3d(2.1, 100.0, 100.0));
  std::printf("%zu points\n", points_in_box(scans, slice, progress).size());
}

}  // namespace adit::bench
