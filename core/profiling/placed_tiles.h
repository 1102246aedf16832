#pragma once
// Scans in their places, and which of their tiles reach which chainages.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/design/alignment.h"
#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/geometry/tile_source.h"
#include "core/profiling/tunnel_frames.h"

namespace adit {

/// A scan with its place: local frame = site minus project origin.
struct PlacedTiles {
  std::string name;
  std::shared_ptr<const TileSource> points;
  Pose local_from_scan = Pose::Identity();
  bool scanner_at_origin = true;  ///< false: ranges are not limited
};

/// A tile and the chainages it may reach.
struct TileRef {
  std::size_t scan = 0;
  std::size_t tile = 0;
  double from_m = 0.0;
  double to_m = 0.0;
  std::size_t scans_beside = 1;  ///< how many scans have tiles at its middle, its own among them
};

/// Made once for scans and an axis (local frame), asked often. Tiles that lie beside the axis altogether are not in it.
class ChainageIndex {
 public:
  ChainageIndex(const std::vector<PlacedTiles>& scans, const Alignment& axis);
  /// Tiles that may hold points of the chainages [from, to], in the order of scans and tiles.
  std::vector<TileRef> between(double from_m, double to_m) const;
  const std::vector<TileRef>& all() const { return tiles_; }

 private:
  void count_scans();

  std::vector<TileRef> tiles_;
};

/// A point with its place on the axis.
struct SlabPoint {
  TunnelPoint at;
  float range_m = 0.0F;  ///< from the scanner
};

/// Calls visit(SlabPoint) for the points of a tile's first `prefix` that lie within the stretch of the frames, in the
/// order of the tile.
template <typename Visit>
void visit_slab_of_tile(const std::vector<PlacedTiles>& scans, const TileRef& ref, std::size_t prefix,
                        const TunnelFrames& frames, const Visit& visit) {
  const PlacedTiles& scan = scans[ref.scan];
  const Eigen::Matrix3d turn = scan.local_from_scan.linear();
  const Eigen::Vector3d shift = scan.local_from_scan.translation();
  const double middle_m = 0.5 * (ref.from_m + ref.to_m);
  const StretchPlanes planes = frames.planes_from(scan.local_from_scan);
  for (const auto& point : scan.points->positions(ref.tile, prefix)) {
    const Eigen::Vector3d p = point.cast<double>();
    if (planes.is_outside(p)) continue;
    if (const auto at = frames.to_tunnel(turn * p + shift, middle_m)) visit({*at, point.norm()});
  }
}

/// Every point whose chainage is in [from, to), scan by scan, tile by tile; tiles are read in parallel.
std::vector<SlabPoint> points_of_slab(const std::vector<PlacedTiles>& scans, const ChainageIndex& index,
                                      const Alignment& axis, double from_m, double to_m, const Progress& progress);

/// Every point within a box of the local frame [m], in the same order.
std::vector<Eigen::Vector3d> points_in_box(const std::vector<PlacedTiles>& scans, const BoundingBox& box,
                                           const Progress& progress);

}  // namespace adit
