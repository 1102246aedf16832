#pragma once
// A stream of points becomes a point store, whatever its size, in a bounded memory.

#include <tbb/task_group.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/cleaning/no_returns.h"
#include "core/foundation/progress.h"
#include "io/atomic_file.h"
#include "io/curve_sorter.h"
#include "io/point_store_header.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"
#include "io/sorted_runs.h"

namespace adit::io {

struct StoreOptions {
  std::string name;           ///< of the scan in the store
  std::string source_sha256;  ///< of the file it comes from (64 hexadecimal digits, or empty)
  std::uint64_t scan = 0;     ///< which scan of the file, from 1; 0: the only one it may hold
  Keep keep = Keep::tenth_millimetre;
  /// Points sorted at once, some 100 bytes each: few, so that they stay near the processor. Sorted runs wait in a
  /// spool file.
  std::size_t run_points = std::size_t{1} << 17;
  /// Leave out pulses without an echo (NoReturnShell), where the scanner is at the origin.
  bool drop_no_returns = true;
};

/// Takes the scans of a file and writes one of them as a store; normals and raster are left out. The store depends on
/// the points alone: not on their order (beyond the first block, which chooses the offset), the memory, or threads.
///
///   StoreWriter writer(path, options);
///   stream_scans(file, {}, writer, progress);
///   writer.write(progress);
///   writer.commit();
class StoreWriter : public ScanSink {
 public:
  StoreWriter(std::filesystem::path path, StoreOptions options);
  /// Waits for what runs in the background; without commit() nothing is left behind.
  ~StoreWriter() noexcept override;
  StoreWriter(const StoreWriter&) = delete;
  StoreWriter& operator=(const StoreWriter&) = delete;

  bool begin(const ScanHeader& scan) override;
  /// Error for points too far apart for one scan.
  void take(PointBlock& block) override;
  void end(std::uint64_t no_returns) override;

  /// Names of all scans the file held.
  const std::vector<std::string>& scans_seen() const { return scans_seen_; }

  /// Sorts, cuts into tiles and writes them to a temporary; lets go of the memory. Error when the file did not hold the
  /// scan, or held several and none was chosen.
  void write(Progress& progress);
  /// After write(): waits for the disk and gives the store its name, in one step.
  void commit();

 private:
  void expect_the_scan() const;
  void watch_ranges(const PointBlock& block, const BoundingBox& box);
  void add(const PointBlock& block);
  void close_run();
  void write_tiles(std::vector<SortedRun> runs, Progress& progress);

  std::filesystem::path path_;
  StoreOptions options_;
  PointStoreHeader header_;
  std::string where_;
  std::vector<std::string> scans_seen_;
  bool taken_ = false;
  bool first_block_ = true;
  std::uint64_t points_ = 0;
  NoReturnShell shell_;
  UnsortedPoints filling_;
  UnsortedPoints sorting_points_;
  SpoolFile spool_;
  CurveSorter sorter_;
  std::vector<SortedRun> runs_;
  std::optional<AtomicFile> written_;
  tbb::task_group sorting_;  ///< at most one run at a time, beside the reader
};

/// A scan in memory as a store (tests, small clouds). Errors as StoreWriter.
void write_point_store(const std::filesystem::path& path, const ScanData& scan, const StoreOptions& options,
                       Progress& progress);

}  // namespace adit::io
