// One row about the decoding loop of the library behind an E57 or LAZ file: the peer of the import.

#include <cstdio>

#include "core/foundation/error.h"
#include "tests/bench/bench.h"
#include "tests/bench/library_loops.h"

namespace adit::bench {
namespace {

std::uint64_t decoded([[maybe_unused]] const std::string& file) {
#ifdef ADIT_BENCH_E57FORMAT
  if (file.ends_with(".e57")) return decode_e57(file);
#endif
#ifdef ADIT_BENCH_LASZIP
  if (file.ends_with(".laz")) return decode_laz(file);
#endif
  return 0;
}

}  // namespace

void bench_decoding(const std::string& file) {
  std::uint64_t points = 0;
  const double seconds = seconds_of(1, [&] { points = decoded(file); });
  if (points == 0) throw Error("nothing was decoded: the library is not built in", file, "run packaging/setup");
  std::printf("| %.1f | %.2f |\n", static_cast<double>(points) / 1e6, static_cast<double>(points) / 1e6 / seconds);
}

}  // namespace adit::bench
