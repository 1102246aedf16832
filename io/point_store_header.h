#pragma once
// The header and the table of a point store, as values and as bytes.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose.h"

namespace adit::io {

inline constexpr std::size_t store_tile_points = 65536;

/// One row of the table.
struct StoredTile {
  std::uint64_t first_point = 0;
  std::uint32_t count = 0;
  std::array<float, 6> box{};  ///< least x y z, greatest x y z
  std::uint64_t overview_checksum = 0;
  std::uint64_t checksum = 0;
  std::uint64_t byte_offset = 0;  ///< in the file; follows from the counts, not stored
};

struct PointStoreHeader {
  std::string name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::optional<Pose> file_pose;
  std::string source_sha256;
  std::uint64_t points = 0;
  std::uint64_t no_returns = 0;
  bool has_intensity = false;
  bool has_colour = false;
  std::vector<StoredTile> tiles;
};

/// Where the parts of a tile of `count` points begin, counted from the tile's first byte.
struct TileLayout {
  std::size_t intensity = 0;
  std::size_t colour = 0;
  std::size_t bytes = 0;  ///< of the whole tile, a multiple of 8
};
TileLayout tile_layout(const PointStoreHeader& header, std::size_t count);

/// Points of a tile that make the overview: the first 64th, at least one.
std::size_t overview_points(std::size_t count);

/// Checksum of the first `prefix` points of a tile (of `count`) with their attributes.
std::uint64_t tile_checksum(const PointStoreHeader& header, std::span<const std::byte> tile, std::size_t count,
                            std::size_t prefix);

/// Header and table as bytes, with their own checksum.
std::string header_bytes(const PointStoreHeader& header);
/// Sets the byte offsets of the tiles; returns the size of the whole file.
std::uint64_t place_tiles(PointStoreHeader& header);

/// The header of a store's bytes; empty unless everything agrees, the size of the file included.
std::optional<PointStoreHeader> parsed_header(std::span<const std::byte> file);

}  // namespace adit::io
