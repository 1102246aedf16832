#pragma once
// More points than memory holds, put into the order of the space-filling curve: sorted runs in a spool file, merged.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/foundation/progress.h"
#include "io/spool_file.h"
#include "io/stored_points.h"

namespace adit::io {

/// Points sorted along the curve, column by column in a spool file; the last of a scan may stay in memory.
struct SortedRun {
  std::size_t count = 0;
  bool has_intensity = false;
  bool has_colour = false;
  bool spooled = false;
  StoredPoints in_memory;
  std::uint64_t positions_at = 0;  ///< offsets in the spool
  std::uint64_t intensity_at = 0;
  std::uint64_t colour_at = 0;
};

/// A run in memory of points that are sorted already.
SortedRun run_of(StoredPoints sorted);

/// A run in the spool of points that are sorted already.
SortedRun spooled_run(const StoredPoints& sorted, SpoolFile& file);

/// Reads runs as one, in order. Memory: a block of each spooled run, together some 64 MB.
class MergedRuns {
 public:
  MergedRuns(std::vector<SortedRun> runs, const SpoolFile& file, Keep keep);
  ~MergedRuns();
  MergedRuns(const MergedRuns&) = delete;
  MergedRuns& operator=(const MergedRuns&) = delete;

  /// Adds further points behind `to`, those for which is_kept(position) is true, until it holds `count`; fewer only at
  /// the end.
  template <typename IsKept>
  void fill(std::size_t count, StoredPoints& to, const IsKept& is_kept) {
    while (to.size() < count && !heap_.empty()) {
      const Stretch stretch = next_stretch(count - to.size());
      std::size_t begin = stretch.begin;
      for (std::size_t i = stretch.begin; i < stretch.end; ++i) {
        if (is_kept(stretch.points->positions[i])) continue;
        to.append(*stretch.points, begin, i);
        begin = i + 1;
      }
      to.append(*stretch.points, begin, stretch.end);
      pass(stretch.end - stretch.begin);
    }
  }

 private:
  /// Points of one run that no other run's points come before.
  struct Stretch {
    const StoredPoints* points;
    std::size_t begin;
    std::size_t end;
  };
  struct Front;

  bool is_behind(std::size_t a, std::size_t b) const;
  Stretch next_stretch(std::size_t most) const;
  void pass(std::size_t count);

  std::vector<std::unique_ptr<Front>> fronts_;
  std::vector<std::size_t> heap_;  ///< runs that have points left, the foremost on top
  Keep keep_;
};

}  // namespace adit::io
