#pragma once
// A scan file being written from a stream of points.

#include <cstdint>
#include <string>
#include <vector>

#include "io/scan_stream.h"

namespace adit::io {

/// What a writer must know of a scan before its first point: headers stand before the points. A first pass over the
/// source gathers it (FactsSink).
struct ScanFacts {
  ScanHeader header;
  std::uint64_t points = 0;             ///< exactly as many as will be handed out
  std::uint64_t no_returns = 0;         ///< places where the scanner saw nothing
  BoundingBox box;                      ///< of the points, file coordinates
  BoundingBox site_box;                 ///< of the points moved by file_pose; as box where there is none
  bool coordinates_are_float32 = true;  ///< every coordinate is a float32 to the last bit
  float least_intensity = 0.0F;
  float greatest_intensity = 0.0F;
  bool whole_intensities = true;
  std::uint32_t rows = 0;  ///< of the raster, one more than the largest row; 0 without a grid
  std::uint32_t columns = 0;
  bool column_by_column = true;  ///< the points come in rising order of column and, within it, of row, no place twice
};

/// Whether file_pose is written beside the points, or applied to them (formats without a pose).
enum class PoseGoes { beside_points, into_points };

/// Gathers the facts of every scan handed to it.
class FactsSink : public ScanSink {
 public:
  bool begin(const ScanHeader& scan) override;
  void take(PointBlock& block) override;
  void end(std::uint64_t no_returns) override;

  std::vector<ScanFacts> scans;

 private:
  void take_positions(const PointBlock& block, ScanFacts& facts) const;
  void take_intensities(const PointBlock& block, ScanFacts& facts) const;
  void take_grid(const PointBlock& block, ScanFacts& facts);

  GridPlace last_place_;
};

/// Takes the same scans again, in the same order, and writes them. Destroyed without commit() it leaves nothing.
class ScanWriter : public ScanSink {
 public:
  /// Makes the file durable and gives it its name.
  virtual void commit() = 0;
};

}  // namespace adit::io
