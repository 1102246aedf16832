#pragma once
// Scans of a stream gathered in memory.

#include <vector>

#include "io/scan_formats.h"
#include "io/scan_stream.h"

namespace adit::io {

/// Memory: 12 bytes a point and its attributes (the raster is dropped).
class ScanCollector : public ScanSink {
 public:
  bool begin(const ScanHeader& scan) override;
  /// Error for points too far apart for one scan.
  void take(PointBlock& block) override;
  void end(std::uint64_t no_returns) override;

  std::vector<ScanData> scans;

 private:
  ScanHeader header_;
};

}  // namespace adit::io
