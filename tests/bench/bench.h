#pragma once
// Timing and the simulated input that the benchmarks share.

#include <chrono>
#include <functional>
#include <string>

#include "tests/core/sample_tunnel.h"

namespace adit::bench {

/// Shortest of several runs [s].
inline double seconds_of(int runs, const std::function<void()>& work) {
  double best = 1e9;
  for (int i = 0; i < runs; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void bench_registration();
void bench_paper();
void bench_stages();
void bench_placement();
void bench_tunnels();
void bench_io();
void bench_profiling();
void bench_profiles();
void bench_targets();
void bench_scan_targets();
/// A row: millions of points, seconds for the index, the first section, a thousand sections.
void bench_sections(const std::string& job);
/// A slice of 0.1 m, x from -10 to -9.9 in the frames of the scans, out of an imported job: how many points it holds.
void bench_slice(const std::string& job);
/// A row: the library's own decoding loop over an E57 or LAZ file, millions of points a second.
void bench_decoding(const std::string& file);

}  // namespace adit::bench
