#pragma once
// Everything that stands inside a clearance line, point by point.

#include <cstdint>
#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/foundation/progress.h"
#include "core/profiling/placed_tiles.h"

namespace adit {

/// A point inside the line.
struct ClearancePoint {
  std::size_t scan = 0;
  TunnelPoint at;
  double inside_m = 0.0;  ///< depth inside the line
};

/// Points that hang together: no gap between them is wider than some 0.4 m.
struct Intrusion {
  std::uint64_t points = 0;
  double from_m = 0.0;  ///< chainage
  double to_m = 0.0;
  bool cut = false;  ///< reaches the end of the stretch, and may go on beyond it
  ClearancePoint deepest;
  Eigen::Vector3d deepest_site = Eigen::Vector3d::Zero();  ///< east, north, elevation
};

struct ClearanceResult {
  std::string line;
  double line_offset_m = 0.0;
  std::uint64_t points = 0;           ///< all that lie inside
  std::vector<Intrusion> intrusions;  ///< in order of chainage
  std::vector<ClearancePoint> list;   ///< every point, up to most_listed; scan by scan
  static constexpr std::size_t most_listed = 1'000'000;
};

/// Every point of every scan within the stretch is looked at, whatever it belongs to, but for what stands nearer to its
/// scanner than least_range_m (the tripod) or farther than most_range_m. deepest_site is left in the design's frame.
ClearanceResult find_intrusions(const std::vector<PlacedTiles>& scans, const ChainageIndex& index,
                                const DesignTunnel& design, const DesignLine& line, double from_m, double to_m,
                                double least_range_m, double most_range_m, Progress& progress);

}  // namespace adit
