#pragma once
// Where points come from: the one interface of core. The store on disk (io), a cloud in memory and tests implement it.

#include <cstddef>
#include <limits>

#include "core/geometry/bounding_box.h"
#include "core/geometry/point_cloud.h"

namespace adit {

inline constexpr std::size_t all_points = std::numeric_limits<std::size_t>::max();

/// A scan cut into tiles. Points of a tile are ordered so that any prefix is an even subsample of the tile.
/// All functions may be called from several threads at once.
class TileSource {
 public:
  virtual ~TileSource() = default;
  virtual std::size_t tile_count() const = 0;
  virtual std::size_t point_count(std::size_t tile) const = 0;
  /// Box of the tile's points, scan frame [m].
  virtual BoundingBox box(std::size_t tile) const = 0;
  /// The first `prefix` points of a tile (all by default), scan frame.
  virtual PointCloud read(std::size_t tile, std::size_t prefix = all_points) const = 0;
  /// The same without attributes.
  virtual std::vector<Eigen::Vector3f> positions(std::size_t tile, std::size_t prefix = all_points) const {
    return read(tile, prefix).points;
  }
};

/// Number of points of all tiles.
std::size_t total_points(const TileSource& source);

/// Puts a cloud into tile order: points sorted along a space-filling (Morton) curve, cut into tiles of at most
/// tile_size points, and inside each tile ordered so that every prefix is an even subsample (bit-reversed positions).
/// The order depends on the points alone, not on the order they came in.
struct TiledCloud {
  PointCloud cloud;
  std::vector<std::size_t> tile_begin;  ///< first point of each tile, and one past the last
};
TiledCloud tiled(PointCloud cloud, std::size_t tile_size = 65536);

/// A cloud in memory as a TileSource.
class CloudTiles : public TileSource {
 public:
  explicit CloudTiles(PointCloud cloud, std::size_t tile_size = 65536) : tiled_(tiled(std::move(cloud), tile_size)) {}
  std::size_t tile_count() const override { return tiled_.tile_begin.size() - 1; }
  std::size_t point_count(std::size_t tile) const override {
    return tiled_.tile_begin[tile + 1] - tiled_.tile_begin[tile];
  }
  BoundingBox box(std::size_t tile) const override;
  PointCloud read(std::size_t tile, std::size_t prefix = all_points) const override;

 private:
  TiledCloud tiled_;
};

}  // namespace adit
