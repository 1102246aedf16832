// ./dev bench [registration] [paper] [stages] [placement] [tunnels] [io] [profiling] [profiles] [targets]
// [scan_targets]; import.py asks for single rows: sections JOB, slice JOB, decoding FILE
#include <pcl/console/print.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/bench/bench.h"

int main(int argc, char** argv) {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a table shows when it is there, not when all are
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  const std::vector<std::pair<std::string, void (*)(const std::string&)>> rows{
      {"sections", adit::bench::bench_sections},
      {"slice", adit::bench::bench_slice},
      {"decoding", adit::bench::bench_decoding}};
  for (const auto& [name, run] : rows) {
    if (wanted.size() != 2 || wanted[0] != name) continue;
    run(wanted[1]);
    return 0;
  }
  const std::vector<std::pair<std::string, void (*)()>> tables{{"registration", adit::bench::bench_registration},
                                                               {"paper", adit::bench::bench_paper},
                                                               {"stages", adit::bench::bench_stages},
                                                               {"placement", adit::bench::bench_placement},
                                                               {"tunnels", adit::bench::bench_tunnels},
                                                               {"io", adit::bench::bench_io},
                                                               {"profiling", adit::bench::bench_profiling},
                                                               {"profiles", adit::bench::bench_profiles},
                                                               {"targets", adit::bench::bench_targets},
                                                               {"scan_targets", adit::bench::bench_scan_targets}};
  for (const std::string& word : wanted)
    if (std::none_of(tables.begin(), tables.end(), [&](const auto& table) { return table.first == word; })) {
      std::fprintf(
          stderr,
          "bench: there is no table \"%s\"; registration, paper, stages, placement, tunnels, io, profiling, profiles, targets, scan_targets\n",
          word.c_str());
      return 2;
    }
  for (const auto& [name, run] : tables)
    if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) run();
  return 0;
}
