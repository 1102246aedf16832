#pragma once
// The description of a point store - what it holds and where its tiles stand - as values and as bytes.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "io/tile_codec.h"

namespace adit::io {

inline constexpr std::size_t store_tile_points = 65536;

/// One row of the table of tiles.
struct StoredTile {
  std::uint64_t first_point = 0;
  TileCode code;
  std::array<float, 6> box{};  ///< least x y z, greatest x y z of the points as they are read
  std::uint64_t overview_checksum = 0;
  std::uint64_t checksum = 0;
  std::uint64_t byte_offset = 0;  ///< in the file; follows from the rows before, not stored
};

struct PointStoreHeader {
  std::string name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::optional<Pose> file_pose;
  std::string source_sha256;
  std::uint64_t source_scan = 0;  ///< which scan of the source, from 1; 0: its only one
  Keep keep = Keep::tenth_millimetre;
  std::uint64_t points = 0;
  std::uint64_t no_returns = 0;
  bool has_intensity = false;
  bool has_colour = false;
  std::vector<StoredTile> tiles;
};

/// Points of a tile that make the overview: the first 64th, at least one.
std::size_t overview_points(std::size_t count);

/// What stands before the first tile: the mark of a store and its version.
std::string store_beginning();

/// What stands behind the last tile: header and table with their own checksum, and how long they are.
std::string store_end(const PointStoreHeader& header);

/// Sets the byte offsets of the tiles; returns the offset behind the last one.
std::uint64_t place_tiles(PointStoreHeader& header);

/// Whether the bytes begin as a store of another version of this program does.
bool is_store_of_other_version(std::span<const std::byte> file);

/// The header of a store's bytes; empty unless everything agrees, the size of the file included.
std::optional<PointStoreHeader> parsed_header(std::span<const std::byte> file);

}  // namespace adit::io
