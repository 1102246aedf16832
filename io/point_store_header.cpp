#include "io/point_store_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/checksum.h"

namespace adit::io {
namespace {

static_assert(std::endian::native == std::endian::little, "a store holds numbers as memory does");

// magic 8, version 4, flags 4, header bytes 8, points 8, no-returns 8, tiles 8, offset 24, pose 128, source 64, name
// length 8
constexpr char magic[] = {'A', 'D', 'I', 'T', 'P', 'N', 'T', 'S'};
constexpr std::uint32_t version = 1;
constexpr std::size_t fixed_bytes = 8 + 4 + 4 + 5 * 8 + 24 + 128 + 64;
constexpr std::size_t row_bytes = 8 + 4 + 4 + 24 + 8 + 8;
constexpr std::size_t longest_name = 4096;
constexpr std::uint32_t flag_intensity = 1;
constexpr std::uint32_t flag_colour = 2;
constexpr std::uint32_t flag_pose = 4;

std::size_t rounded_up_to_8(std::size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

class Writer {
 public:
  template <typename T>
  void put(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  void put_padded(const std::string& text, std::size_t size) {
    bytes += text;
    bytes.append(size - text.size(), '\0');
  }
  std::string bytes;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <typename T>
  T get() {
    T value;
    std::memcpy(&value, bytes_.data() + next_, sizeof(T));
    next_ += sizeof(T);
    return value;
  }
  std::string text(std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes_.data() + next_), size);
    next_ += size;
    return text;
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
};

std::size_t size_of_header(std::size_t name, std::size_t tiles) {
  return rounded_up_to_8(fixed_bytes + name) + tiles * row_bytes + 8;
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

bool is_sound(const StoredTile& tile, std::uint64_t points_before) {
  if (tile.first_point != points_before || tile.count == 0 || tile.count > store_tile_points) return false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(tile.box[axis]) || !std::isfinite(tile.box[axis + 3]) || tile.box[axis] > tile.box[axis + 3])
      return false;
  return true;
}

/// The parts between magic and table; empty when they are out of range.
std::optional<PointStoreHeader> parsed_fixed_part(Reader& reader, std::uint64_t& tiles, std::size_t file_bytes) {
  PointStoreHeader header;
  if (reader.get<std::uint32_t>() != version) return std::nullopt;
  const auto flags = reader.get<std::uint32_t>();
  header.has_intensity = (flags & flag_intensity) != 0;
  header.has_colour = (flags & flag_colour) != 0;
  const auto bytes = reader.get<std::uint64_t>();
  header.points = reader.get<std::uint64_t>();
  header.no_returns = reader.get<std::uint64_t>();
  tiles = reader.get<std::uint64_t>();
  const auto name_bytes = reader.get<std::uint64_t>();
  for (double& c : header.offset) c = reader.get<double>();
  Eigen::Matrix4d pose;
  for (double& c : pose.reshaped()) c = reader.get<double>();
  header.source_sha256 = reader.text(64);
  header.source_sha256.resize(std::min(header.source_sha256.find('\0'), header.source_sha256.size()));
  if (name_bytes > longest_name || tiles == 0 || tiles > file_bytes / row_bytes || bytes > file_bytes ||
      bytes != size_of_header(name_bytes, tiles))
    return std::nullopt;
  header.name = reader.text(name_bytes);
  reader.text(rounded_up_to_8(fixed_bytes + name_bytes) - fixed_bytes - name_bytes);
  if ((flags & flag_pose) != 0) {
    if (!is_rigid(pose)) return std::nullopt;
    header.file_pose = Pose(pose);
  }
  if (!header.offset.allFinite()) return std::nullopt;
  return header;
}

}  // namespace

TileLayout tile_layout(const PointStoreHeader& header, std::size_t count) {
  TileLayout layout;
  layout.intensity = 12 * count;
  layout.colour = layout.intensity + (header.has_intensity ? 4 * count : 0);
  layout.bytes = rounded_up_to_8(layout.colour + (header.has_colour ? 3 * count : 0));
  return layout;
}

std::size_t overview_points(std::size_t count) {
  return (count + 63) / 64;
}

std::uint64_t tile_checksum(const PointStoreHeader& header, std::span<const std::byte> tile, std::size_t count,
                            std::size_t prefix) {
  const TileLayout layout = tile_layout(header, count);
  Checksum sum;
  sum.add(tile.subspan(0, 12 * prefix));
  if (header.has_intensity) sum.add(tile.subspan(layout.intensity, 4 * prefix));
  if (header.has_colour) sum.add(tile.subspan(layout.colour, 3 * prefix));
  return sum.value();
}

std::string header_bytes(const PointStoreHeader& header) {
  const std::string name = header.name.substr(0, longest_name);
  Writer writer;
  writer.bytes.append(magic, sizeof magic);
  writer.put(version);
  writer.put<std::uint32_t>((header.has_intensity ? flag_intensity : 0) | (header.has_colour ? flag_colour : 0) |
                            (header.file_pose ? flag_pose : 0));
  for (const std::uint64_t number : {std::uint64_t{size_of_header(name.size(), header.tiles.size())}, header.points,
                                     header.no_returns, std::uint64_t{header.tiles.size()}, std::uint64_t{name.size()}})
    writer.put(number);
  for (const double c : header.offset) writer.put(c);
  const Eigen::Matrix4d pose = header.file_pose.value_or(Pose::Identity()).matrix();
  for (const double c : pose.reshaped()) writer.put(c);
  writer.put_padded(header.source_sha256.substr(0, 64), 64);
  writer.put_padded(name, rounded_up_to_8(fixed_bytes + name.size()) - fixed_bytes);
  for (const StoredTile& tile : header.tiles) {
    writer.put(tile.first_point);
    writer.put(tile.count);
    writer.put<std::uint32_t>(0);
    for (const float c : tile.box) writer.put(c);
    writer.put(tile.overview_checksum);
    writer.put(tile.checksum);
  }
  writer.put(checksum_of(std::as_bytes(std::span(writer.bytes))));
  return std::move(writer.bytes);
}

std::uint64_t place_tiles(PointStoreHeader& header) {
  std::uint64_t next = size_of_header(std::min(header.name.size(), longest_name), header.tiles.size());
  for (StoredTile& tile : header.tiles) {
    tile.byte_offset = next;
    next += tile_layout(header, tile.count).bytes;
  }
  return next;
}

std::optional<PointStoreHeader> parsed_header(std::span<const std::byte> file) {
  if (file.size() < fixed_bytes + 8 || std::memcmp(file.data(), magic, sizeof magic) != 0) return std::nullopt;
  Reader reader(file);
  reader.text(sizeof magic);
  std::uint64_t tiles = 0;
  std::optional<PointStoreHeader> header = parsed_fixed_part(reader, tiles, file.size());
  if (!header) return std::nullopt;
  const std::size_t bytes = size_of_header(header->name.size(), tiles);
  std::uint64_t stored = 0;
  std::memcpy(&stored, file.data() + bytes - 8, 8);
  if (stored != checksum_of(file.first(bytes - 8))) return std::nullopt;
  std::uint64_t points = 0;
  for (std::uint64_t t = 0; t < tiles; ++t) {
    StoredTile tile;
    tile.first_point = reader.get<std::uint64_t>();
    tile.count = reader.get<std::uint32_t>();
    reader.get<std::uint32_t>();
    for (float& c : tile.box) c = reader.get<float>();
    tile.overview_checksum = reader.get<std::uint64_t>();
    tile.checksum = reader.get<std::uint64_t>();
    if (!is_sound(tile, points)) return std::nullopt;
    points += tile.count;
    header->tiles.push_back(tile);
  }
  if (points != header->points || place_tiles(*header) != file.size()) return std::nullopt;
  return header;
}

}  // namespace adit::io
