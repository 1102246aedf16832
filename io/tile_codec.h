#pragma once
// The bytes of one tile: columns of numbers, each as wide as the tile needs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/point_cloud.h"
#include "io/stored_points.h"

namespace adit::io {

/// Numbers of a tile: x, y, z, intensity, colour (24 bits).
inline constexpr std::size_t tile_columns = 5;

/// How a tile's bytes are to be read. A stored coordinate is origin + number; an intensity of 32 bits is a float,
/// narrower ones are whole numbers (or all zero: no width).
struct TileCode {
  std::uint32_t count = 0;
  std::array<std::int32_t, 3> origin{};
  std::array<std::uint8_t, tile_columns> width{};  ///< bits, 0 to 32
};

/// Where column `column` begins, and behind the last one the tile's bytes (a multiple of 8, with 8 to spare).
std::size_t column_offset(const TileCode& code, std::size_t column);
std::size_t tile_bytes(const TileCode& code);

/// Packs the points in the order given: for even prefixes that order must be even_prefix_order of a sorted tile.
struct EncodedTile {
  TileCode code;
  std::vector<std::byte> bytes;
};
EncodedTile encoded_tile(const StoredPoints& points, std::span<const std::uint32_t> order, Keep keep);

/// The first `prefix` points; intensity and colour as asked for.
struct WantedColumns {
  bool intensity = false;
  bool colour = false;
};
PointCloud decoded_tile(const TileCode& code, const std::byte* tile, std::size_t prefix, Keep keep,
                        WantedColumns wanted);

/// Checksum of the bytes that hold the first `prefix` points.
std::uint64_t prefix_checksum(const TileCode& code, const std::byte* tile, std::size_t prefix);

}  // namespace adit::io
