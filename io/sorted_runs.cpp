#include "io/sorted_runs.h"

#include <algorithm>
#include <utility>

namespace adit::io {
namespace {

/// Few runs are read in long blocks, many in short ones.
std::size_t block_points_of(std::size_t runs) {
  constexpr std::size_t all_points = std::size_t{1} << 21;
  return std::clamp<std::size_t>(all_points / std::max<std::size_t>(runs, 1), 256, 65536);
}

template <typename T>
std::uint64_t spool_column(const std::vector<T>& values, SpoolFile& file) {
  return file.append(values.data(), values.size() * sizeof(T));
}

template <typename T>
void read_column(const SpoolFile& file, std::uint64_t at, std::size_t begin, std::size_t count, std::vector<T>& to) {
  to.resize(count);
  file.read(at + begin * sizeof(T), to.data(), count * sizeof(T));
}

}  // namespace

SortedRun run_of(StoredPoints sorted) {
  SortedRun run;
  run.count = sorted.size();
  run.has_intensity = !sorted.intensity.empty();
  run.has_colour = !sorted.colour.empty();
  run.in_memory = std::move(sorted);
  return run;
}

SortedRun spooled_run(const StoredPoints& sorted, SpoolFile& file) {
  SortedRun run;
  run.count = sorted.size();
  run.has_intensity = !sorted.intensity.empty();
  run.has_colour = !sorted.colour.empty();
  run.spooled = true;
  run.positions_at = spool_column(sorted.positions, file);
  run.intensity_at = spool_column(sorted.intensity, file);
  run.colour_at = spool_column(sorted.colour, file);
  return run;
}

/// A run as far as it has been read: block by block from the spool; one in memory is its own only block.
struct MergedRuns::Front {
  SortedRun run;
  const SpoolFile& file;
  std::size_t block_points;
  StoredPoints block;
  std::vector<std::uint64_t> keys;  ///< of the block's points from first_key on
  std::size_t first_key = 0;
  std::size_t next = 0;  ///< in the block
  std::size_t read = 0;  ///< points of the run that are or were in a block

  const StoredPoints& points() const { return run.spooled ? block : run.in_memory; }
  std::uint64_t key(std::size_t i) const { return keys[i - first_key]; }

  /// The next block; false when the run has no more.
  bool refill() {
    const std::size_t count = run.spooled ? std::min(block_points, run.count - read) : run.count - read;
    if (count == 0) return false;
    if (run.spooled) {
      read_column(file, run.positions_at, read, count, block.positions);
      if (run.has_intensity) read_column(file, run.intensity_at, read, count, block.intensity);
      if (run.has_colour) read_column(file, run.colour_at, read, count, block.colour);
    }
    read += count;
    next = 0;
    first_key = 0;
    keys.clear();
    return true;
  }
  /// Keys of the present point and some thousand behind it.
  void make_keys(Keep keep) {
    const std::size_t end = std::min(points().size(), next + block_points);
    first_key = next;
    keys.resize(end - next);
    for (std::size_t i = next; i < end; ++i) keys[i - next] = curve_key(points().positions[i], keep);
  }
  std::size_t keys_end() const { return first_key + keys.size(); }
};

MergedRuns::MergedRuns(std::vector<SortedRun> runs, const SpoolFile& file, Keep keep) : keep_(keep) {
  const std::size_t block_points = block_points_of(runs.size());
  for (SortedRun& run : runs) {
    fronts_.push_back(std::unique_ptr<Front>(new Front{std::move(run), file, block_points, {}, {}}));
    if (fronts_.back()->refill()) heap_.push_back(fronts_.size() - 1);
  }
  if (heap_.size() > 1)
    for (const std::size_t i : heap_) fronts_[i]->make_keys(keep_);
  std::make_heap(heap_.begin(), heap_.end(), [&](std::size_t a, std::size_t b) { return is_behind(a, b); });
}

MergedRuns::~MergedRuns() = default;

bool MergedRuns::is_behind(std::size_t a, std::size_t b) const {
  const Front& f = *fronts_[a];
  const Front& g = *fronts_[b];
  return comes_before(g.points(), g.next, g.key(g.next), f.points(), f.next, f.key(f.next));
}

MergedRuns::Stretch MergedRuns::next_stretch(std::size_t most) const {
  const Front& first = *fronts_[heap_.front()];
  const StoredPoints& points = first.points();
  std::size_t end = std::min(points.size(), first.next + most);
  if (heap_.size() > 1) {
    const std::size_t other = heap_.size() == 2 || is_behind(heap_[2], heap_[1]) ? heap_[1] : heap_[2];
    const Front& second = *fronts_[other];
    const std::uint64_t limit = second.key(second.next);
    end = std::min(end, first.keys_end());
    std::size_t i = first.next + 1;
    while (i < end && (first.key(i) < limit ||
                       (first.key(i) == limit && comes_before(points, i, limit, second.points(), second.next, limit))))
      ++i;
    end = i;
  }
  return {&points, first.next, end};
}

void MergedRuns::pass(std::size_t count) {
  const auto behind = [&](std::size_t a, std::size_t b) { return is_behind(a, b); };
  const std::size_t first = heap_.front();
  Front& front = *fronts_[first];
  std::pop_heap(heap_.begin(), heap_.end(), behind);
  heap_.pop_back();
  front.next += count;
  if (front.next == front.points().size() && !front.refill()) {
    front.run.in_memory = {};
    return;
  }
  if (!heap_.empty() && front.next >= front.keys_end()) front.make_keys(keep_);
  heap_.push_back(first);
  std::push_heap(heap_.begin(), heap_.end(), behind);
}

}  // namespace adit::io
