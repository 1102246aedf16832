#include "io/sorted_runs.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr std::size_t block_points = 65536;

template <typename T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(order.size());
  for (const std::uint32_t i : order) result.push_back(values[i]);
  return result;
}

template <typename T>
std::uint64_t spool_column(std::vector<T>& values, SpoolFile& file) {
  const std::uint64_t at = file.append(values.data(), values.size() * sizeof(T));
  std::vector<T>().swap(values);
  return at;
}

template <typename T>
void read_column(const SpoolFile& file, std::uint64_t at, std::size_t begin, std::size_t count, std::vector<T>& to) {
  to.resize(count);
  file.read(at + begin * sizeof(T), to.data(), count * sizeof(T));
}

}  // namespace

SpoolFile::~SpoolFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t SpoolFile::append(const void* bytes, std::size_t count) {
  const auto fail = [&](const std::string& what) {
    throw Error(what + " (" + std::strerror(errno) + ")", folder_.string(),
                errno == ENOSPC || errno == EDQUOT ? "free some space or write to another disk"
                                                   : "check the folder and the disk");
  };
  if (descriptor_ < 0) {
    std::string name = (folder_ / ".adit-spool-XXXXXX").string();
    descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) fail("the spool file cannot be made");
    ::unlink(name.c_str());
  }
  const std::uint64_t at = size_;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(descriptor_, from, count, static_cast<off_t>(size_));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("the spool file cannot be written");
    from += written;
    size_ += static_cast<std::uint64_t>(written);
    count -= static_cast<std::size_t>(written);
  }
  return at;
}

void SpoolFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  char* place = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, place, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error("the spool file cannot be read", folder_.string(), "check the disk");
    place += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
}

SortedRun sorted_run(StoredPoints points, Keep keep) {
  const std::vector<std::uint32_t> order = curve_order(points, keep);
  SortedRun run;
  run.count = points.size();
  run.has_intensity = !points.intensity.empty();
  run.has_colour = !points.colour.empty();
  run.in_memory.positions = in_order(points.positions, order);
  points.positions = {};
  run.in_memory.intensity = in_order(points.intensity, order);
  points.intensity = {};
  run.in_memory.colour = in_order(points.colour, order);
  return run;
}

void spool(SortedRun& run, SpoolFile& file) {
  StoredPoints& points = run.in_memory;
  run.positions_at = spool_column(points.positions, file);
  if (run.has_intensity) run.intensity_at = spool_column(points.intensity, file);
  if (run.has_colour) run.colour_at = spool_column(points.colour, file);
  run.spooled = true;
}

/// A run as far as it has been read.
struct MergedRuns::Front {
  SortedRun run;
  const SpoolFile& file;
  StoredPoints block;
  std::vector<std::uint64_t> keys;  ///< of the block
  std::size_t next = 0;             ///< in the block
  std::size_t read = 0;             ///< points of the run that are or were in a block

  /// The next block; false when the run has no more.
  bool refill(Keep keep) {
    const std::size_t count = std::min(block_points, run.count - read);
    if (count == 0) return false;
    if (run.spooled) {
      read_column(file, run.positions_at, read, count, block.positions);
      if (run.has_intensity) read_column(file, run.intensity_at, read, count, block.intensity);
      if (run.has_colour) read_column(file, run.colour_at, read, count, block.colour);
    } else {
      block.clear();
      block.append(run.in_memory, read, read + count);
    }
    keys.resize(count);
    for (std::size_t i = 0; i < count; ++i) keys[i] = curve_key(block.positions[i], keep);
    read += count;
    next = 0;
    return true;
  }
};

MergedRuns::MergedRuns(std::vector<SortedRun> runs, const SpoolFile& file, Keep keep) : keep_(keep) {
  for (SortedRun& run : runs) {
    fronts_.push_back(std::unique_ptr<Front>(new Front{std::move(run), file, {}, {}}));
    if (fronts_.back()->refill(keep_)) heap_.push_back(fronts_.size() - 1);
  }
  std::make_heap(heap_.begin(), heap_.end(), [&](std::size_t a, std::size_t b) { return is_behind(a, b); });
}

MergedRuns::~MergedRuns() = default;

bool MergedRuns::is_behind(std::size_t a, std::size_t b) const {
  const Front& f = *fronts_[a];
  const Front& g = *fronts_[b];
  return comes_before(g.block, g.next, g.keys[g.next], f.block, f.next, f.keys[f.next]);
}

MergedRuns::Stretch MergedRuns::next_stretch(std::size_t most) const {
  const Front& first = *fronts_[heap_.front()];
  std::size_t end = std::min(first.block.size(), first.next + most);
  if (heap_.size() > 1) {
    const std::size_t other = heap_.size() == 2 || is_behind(heap_[2], heap_[1]) ? heap_[1] : heap_[2];
    const Front& second = *fronts_[other];
    const std::uint64_t limit = second.keys[second.next];
    std::size_t i = first.next + 1;
    while (i < end &&
           (first.keys[i] < limit || comes_before(first.block, i, first.keys[i], second.block, second.next, limit)))
      ++i;
    end = std::min(i, end);
  }
  return {&first.block, first.next, end};
}

void MergedRuns::pass(std::size_t count) {
  const auto behind = [&](std::size_t a, std::size_t b) { return is_behind(a, b); };
  const std::size_t first = heap_.front();
  std::pop_heap(heap_.begin(), heap_.end(), behind);
  heap_.pop_back();
  Front& front = *fronts_[first];
  front.next += count;
  if (front.next == front.block.size() && !front.refill(keep_)) return;
  heap_.push_back(first);
  std::push_heap(heap_.begin(), heap_.end(), behind);
}

}  // namespace adit::io
