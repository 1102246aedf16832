#pragma once
// A look at some points of a file: at even places of a large one, at all points of a small one.

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/geometry/bounding_box.h"
#include "io/bytes.h"
#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// True for files that are read whole for their summary; no sample is taken of them.
bool is_read_whole(std::uint64_t file_bytes);

/// What was seen of a scan.
struct ScanSample {
  BoundingBox box;                      ///< file coordinates
  std::uint64_t points = 0;             ///< looked at
  std::vector<Eigen::Vector3d> spread;  ///< some of them, spread evenly over the scan
  double stands_for = 1.0;              ///< points of the scan for each of `spread`
  double bytes_per_point = 0.0;         ///< of text
};

/// Up to 96 records at each of 2048 places, spread evenly over `count` records from `begin`. position: of a record;
/// what is not finite is passed over. Nothing for a file that is read whole.
ScanSample sample_records(const InputFile& file, std::uint64_t begin, std::uint64_t record_bytes, std::uint64_t count,
                          const std::function<Eigen::Vector3d(const std::byte*)>& position);

/// Where x, y and z stand on a line.
struct TextColumns {
  char separator = '\0';  ///< '\0': blanks
  std::array<std::size_t, 3> xyz = {0, 1, 2};
  bool zero_is_no_return = false;  ///< 0 0 0 is no point
};

/// The whole lines in 4 KiB at each of up to 2048 places, spread evenly over the bytes from `begin` to `end`. Lines
/// without three numbers are passed over. points: how many lie there, 0 when unknown. Nothing for a file that is read
/// whole.
ScanSample sample_lines(const InputFile& file, std::uint64_t begin, std::uint64_t end, const TextColumns& columns,
                        std::uint64_t points);

/// Puts what was seen into a summary: box (unless the header gave one), number of points looked at, density.
void take_sample(ScanSummary& summary, const ScanSample& sample);

/// Looks at all points of a file.
class WholeScans : public ScanSink {
 public:
  bool begin(const ScanHeader& scan) override;
  void take(PointBlock& block) override;
  void end(std::uint64_t no_returns) override;

  /// Puts what was seen into the summary of the same file.
  void complete(ScanFileSummary& summary) const;

 private:
  struct Seen {
    ScanSample sample;
    std::uint64_t no_returns = 0;
  };
  std::vector<Seen> scans_;
};

}  // namespace adit::io
