#include "io/tile_codec.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/checksum.h"
#include "io/packed_bits.h"

namespace adit::io {
namespace {

constexpr std::size_t intensity_column = 3;
constexpr std::size_t colour_column = 4;

unsigned bits_for(std::uint32_t largest) {
  return static_cast<unsigned>(std::bit_width(largest));
}

/// 8 or 16 bits where all intensities are such whole numbers, else a float's 32.
unsigned intensity_width(const std::vector<float>& values) {
  float largest = 0.0F;
  for (const float value : values) {
    if (!(value >= 0.0F && value <= 65535.0F) || std::signbit(value)) return 32;
    if (value != static_cast<float>(static_cast<std::int32_t>(value))) return 32;
    largest = std::max(largest, value);
  }
  return bits_for(static_cast<std::uint32_t>(largest));
}

void pack(std::size_t column, std::span<const std::uint32_t> numbers, unsigned width, EncodedTile& tile) {
  tile.code.width[column] = static_cast<std::uint8_t>(width);
  pack_bits(numbers, width, tile.bytes);
  tile.bytes.resize(column_offset(tile.code, column + 1));
}

/// Least coordinates and the bits that the greatest takes above them; float32 is kept as it is.
void choose_widths(const StoredPoints& points, Keep keep, TileCode& code) {
  code.width = {32, 32, 32, 0, 0};
  if (keep == Keep::float32 || points.size() == 0) return;
  const StoredPosition first = points.positions.front();
  StoredPosition least = first;
  StoredPosition most = first;
  for (const StoredPosition& p : points.positions)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], p[axis]);
      most[axis] = std::max(most[axis], p[axis]);
    }
  code.origin = least;
  for (std::size_t axis = 0; axis < 3; ++axis)
    code.width[axis] = static_cast<std::uint8_t>(
        bits_for(static_cast<std::uint32_t>(most[axis]) - static_cast<std::uint32_t>(least[axis])));
}

void pack_positions(const StoredPoints& points, std::span<const std::uint32_t> order, Keep keep, EncodedTile& tile) {
  choose_widths(points, keep, tile.code);
  const std::size_t n = order.size();
  std::vector<std::uint32_t> numbers(3 * n);
  const auto zero = [&](std::size_t axis) { return static_cast<std::uint32_t>(tile.code.origin[axis]); };
  const std::uint32_t zeros[] = {zero(0), zero(1), zero(2)};
  for (std::size_t i = 0; i < n; ++i) {
    const StoredPosition& p = points.positions[order[i]];
    for (std::size_t axis = 0; axis < 3; ++axis)
      numbers[axis * n + i] = static_cast<std::uint32_t>(p[axis]) - zeros[axis];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
    pack(axis, std::span(numbers).subspan(axis * n, n), tile.code.width[axis], tile);
}

void unpack_axis(const TileCode& code, const std::byte* from, std::size_t axis, Keep keep, PointCloud& cloud) {
  const unsigned width = code.width[axis];
  const auto k = static_cast<Eigen::Index>(axis);
  const auto origin = static_cast<std::uint32_t>(code.origin[axis]);
  if (keep == Keep::float32) {
    for (std::size_t i = 0; i < cloud.points.size(); ++i)
      cloud.points[i][k] = std::bit_cast<float>(packed_number(from, i, width));
    return;
  }
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto stored = static_cast<std::int32_t>(origin + packed_number(from, i, width));
    cloud.points[i][k] = static_cast<float>(static_cast<double>(stored) * stored_step_m);
  }
}

}  // namespace

std::size_t column_offset(const TileCode& code, std::size_t column) {
  std::size_t offset = 0;
  for (std::size_t c = 0; c < column; ++c) offset += (packed_bytes(code.count, code.width[c]) + 7) / 8 * 8;
  return offset;
}

std::size_t tile_bytes(const TileCode& code) {
  return column_offset(code, tile_columns) + 8;
}

EncodedTile encoded_tile(const StoredPoints& points, std::span<const std::uint32_t> order, Keep keep) {
  EncodedTile tile;
  tile.code.count = static_cast<std::uint32_t>(order.size());
  tile.bytes.reserve(order.size() * 20);
  pack_positions(points, order, keep, tile);
  std::vector<std::uint32_t> numbers(order.size());
  if (!points.intensity.empty()) {
    const unsigned width = intensity_width(points.intensity);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const float value = points.intensity[order[i]];
      numbers[i] = width == 32 ? std::bit_cast<std::uint32_t>(value) : static_cast<std::uint32_t>(value);
    }
    pack(intensity_column, numbers, width, tile);
  }
  if (!points.colour.empty()) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      const auto& c = points.colour[order[i]];
      numbers[i] = std::uint32_t{c[0]} | std::uint32_t{c[1]} << 8 | std::uint32_t{c[2]} << 16;
    }
    pack(colour_column, numbers, 24, tile);
  }
  tile.bytes.resize(tile_bytes(tile.code));
  return tile;
}

PointCloud decoded_tile(const TileCode& code, const std::byte* tile, std::size_t prefix, Keep keep,
                        WantedColumns wanted) {
  PointCloud cloud;
  cloud.points.resize(prefix);
  for (std::size_t axis = 0; axis < 3; ++axis) unpack_axis(code, tile + column_offset(code, axis), axis, keep, cloud);
  if (wanted.intensity) {
    const unsigned width = code.width[intensity_column];
    const std::byte* from = tile + column_offset(code, intensity_column);
    cloud.intensity.resize(prefix);
    for (std::size_t i = 0; i < prefix; ++i) {
      const std::uint32_t number = packed_number(from, i, width);
      cloud.intensity[i] = width == 32 ? std::bit_cast<float>(number) : static_cast<float>(number);
    }
  }
  if (wanted.colour) {
    const std::byte* from = tile + column_offset(code, colour_column);
    cloud.colour.resize(prefix);
    for (std::size_t i = 0; i < prefix; ++i) {
      const std::uint32_t number = packed_number(from, i, code.width[colour_column]);
      for (unsigned c = 0; c < 3; ++c) cloud.colour[i][c] = static_cast<std::uint8_t>(number >> (8 * c));
    }
  }
  return cloud;
}

std::uint64_t prefix_checksum(const TileCode& code, const std::byte* tile, std::size_t prefix) {
  Checksum sum;
  if (prefix >= code.count) {
    sum.add({tile, tile_bytes(code)});
  } else {
    for (std::size_t column = 0; column < tile_columns; ++column)
      sum.add({tile + column_offset(code, column), packed_bytes(prefix, code.width[column])});
  }
  return sum.value();
}

}  // namespace adit::io
