#include "app/pair_sections.h"

#include <algorithm>

namespace adit::app {
namespace {

constexpr std::size_t points_of_a_scan = 4000;

std::size_t index_of(const JobState& state, const std::string& scan) {
  const auto& scans = state.results.registration.scans;
  const auto found =
      std::find_if(scans.begin(), scans.end(), [&](const PlacedScan& placed) { return placed.name == scan; });
  return static_cast<std::size_t>(found - scans.begin());
}

}  // namespace

std::vector<render::PairSection> pair_sections(const JobState& state, std::size_t most, const Progress& progress) {
  std::vector<PairResult> pairs = state.results.registration.pairs;
  std::stable_sort(pairs.begin(), pairs.end(), [](const PairResult& a, const PairResult& b) {
    return a.used != b.used ? a.used : a.rms_m > b.rms_m;
  });
  if (pairs.size() > most) pairs.resize(most);
  std::vector<render::PairSection> sections;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    progress.step(i, pairs.size());
    const std::size_t target = index_of(state, pairs[i].target);
    const std::size_t source = index_of(state, pairs[i].source);
    const auto& scans = state.results.registration.scans;
    const Pose local_from_source =
        pairs[i].used ? scans[source].local_from_scan : scans[target].local_from_scan * pairs[i].target_from_source;
    sections.push_back(
        {pairs[i], overlap_section(*state.stores[target], scans[target].local_from_scan, *state.stores[source],
                                   local_from_source, points_of_a_scan, progress)});
  }
  return sections;
}

}  // namespace adit::app
