#include "io/point_store_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "io/checksum.h"

namespace adit::io {
namespace {

static_assert(std::endian::native == std::endian::little, "a store holds numbers as memory does");

constexpr char mark[] = {'A', 'D', 'I', 'T', 'P', 'N', 'T', 'S'};
constexpr std::uint32_t version = 2;
constexpr std::size_t beginning_bytes = 16;  // mark, version, four bytes of zero
// flags 4 + 4, points, no-returns, scan, tiles, name length 5 x 8, offset 24, pose 128, source 64
constexpr std::size_t fixed_bytes = 8 + 5 * 8 + 24 + 128 + 64;
// first point 8, count 4, origin 12, widths 5 + 3 of zero, box 24, checksums 16
constexpr std::size_t row_bytes = 8 + 4 + 12 + 8 + 24 + 16;
constexpr std::size_t end_bytes = 16;  // checksum, length of everything before it
constexpr std::size_t longest_name = 4096;
constexpr std::uint32_t flag_intensity = 1;
constexpr std::uint32_t flag_colour = 2;
constexpr std::uint32_t flag_pose = 4;
constexpr std::uint32_t flag_float32 = 8;

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
  return fixed_bytes + name + tiles * row_bytes;
}

std::uint64_t checksum_of(std::span<const std::byte> bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.value();
}

void put_row(Writer& writer, const StoredTile& tile) {
  writer.put(tile.first_point);
  writer.put(tile.code.count);
  for (const std::int32_t c : tile.code.origin) writer.put(c);
  for (const std::uint8_t width : tile.code.width) writer.put(width);
  for (std::size_t i = tile_columns; i < 8; ++i) writer.put(std::uint8_t{0});
  for (const float c : tile.box) writer.put(c);
  writer.put(tile.overview_checksum);
  writer.put(tile.checksum);
}

StoredTile row_of(Reader& reader) {
  StoredTile tile;
  tile.first_point = reader.get<std::uint64_t>();
  tile.code.count = reader.get<std::uint32_t>();
  for (std::int32_t& c : tile.code.origin) c = reader.get<std::int32_t>();
  for (std::uint8_t& width : tile.code.width) width = reader.get<std::uint8_t>();
  for (std::size_t i = tile_columns; i < 8; ++i) reader.get<std::uint8_t>();
  for (float& c : tile.box) c = reader.get<float>();
  tile.overview_checksum = reader.get<std::uint64_t>();
  tile.checksum = reader.get<std::uint64_t>();
  return tile;
}

bool is_sound(const StoredTile& tile, std::uint64_t points_before) {
  const TileCode& code = tile.code;
  if (tile.first_point != points_before || code.count == 0 || code.count > store_tile_points) return false;
  if (*std::max_element(code.width.begin(), code.width.end()) > 32) return false;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!std::isfinite(tile.box[axis]) || !std::isfinite(tile.box[axis + 3]) || tile.box[axis] > tile.box[axis + 3])
      return false;
  return true;
}

/// Everything before the table; empty when it is out of range.
std::optional<PointStoreHeader> parsed_fixed_part(Reader& reader, std::uint64_t& tiles, std::size_t bytes) {
  PointStoreHeader header;
  const auto flags = reader.get<std::uint32_t>();
  reader.get<std::uint32_t>();
  header.has_intensity = (flags & flag_intensity) != 0;
  header.has_colour = (flags & flag_colour) != 0;
  header.keep = (flags & flag_float32) != 0 ? Keep::float32 : Keep::tenth_millimetre;
  header.points = reader.get<std::uint64_t>();
  header.no_returns = reader.get<std::uint64_t>();
  header.source_scan = reader.get<std::uint64_t>();
  tiles = reader.get<std::uint64_t>();
  const auto name_bytes = reader.get<std::uint64_t>();
  for (double& c : header.offset) c = reader.get<double>();
  Eigen::Matrix4d pose;
  for (double& c : pose.reshaped()) c = reader.get<double>();
  header.source_sha256 = reader.text(64);
  header.source_sha256.resize(std::min(header.source_sha256.find('\0'), header.source_sha256.size()));
  if (name_bytes > longest_name || tiles == 0 || tiles > bytes / row_bytes ||
      bytes != size_of_header(name_bytes, tiles))
    return std::nullopt;
  header.name = reader.text(name_bytes);
  if ((flags & flag_pose) != 0) {
    if (!is_rigid(pose)) return std::nullopt;
    header.file_pose = Pose(pose);
  }
  if (!header.offset.allFinite()) return std::nullopt;
  return header;
}

/// The bytes of header and table; nothing unless their checksum holds.
std::span<const std::byte> header_part(std::span<const std::byte> file) {
  if (file.size() < beginning_bytes + fixed_bytes + row_bytes + end_bytes) return {};
  const std::string beginning = store_beginning();
  if (std::memcmp(file.data(), beginning.data(), beginning.size()) != 0) return {};
  Reader end(file.last(end_bytes));
  const auto checksum = end.get<std::uint64_t>();
  const auto bytes = end.get<std::uint64_t>();
  if (bytes < fixed_bytes || bytes > file.size() - beginning_bytes - end_bytes) return {};
  const auto part = file.subspan(file.size() - end_bytes - bytes, bytes);
  return checksum_of(part) == checksum ? part : std::span<const std::byte>();
}

}  // namespace

std::size_t overview_points(std::size_t count) {
  return (count + 63) / 64;
}

std::string store_beginning() {
  Writer writer;
  writer.bytes.append(mark, sizeof mark);
  writer.put(version);
  writer.put(std::uint32_t{0});
  return std::move(writer.bytes);
}

std::string store_end(const PointStoreHeader& header) {
  const std::string name = header.name.substr(0, longest_name);
  Writer writer;
  writer.put<std::uint32_t>((header.has_intensity ? flag_intensity : 0) | (header.has_colour ? flag_colour : 0) |
                            (header.file_pose ? flag_pose : 0) | (header.keep == Keep::float32 ? flag_float32 : 0));
  writer.put(std::uint32_t{0});
  for (const std::uint64_t number : {header.points, header.no_returns, header.source_scan,
                                     std::uint64_t{header.tiles.size()}, std::uint64_t{name.size()}})
    writer.put(number);
  for (const double c : header.offset) writer.put(c);
  const Eigen::Matrix4d pose = header.file_pose.value_or(Pose::Identity()).matrix();
  for (const double c : pose.reshaped()) writer.put(c);
  writer.put_padded(header.source_sha256.substr(0, 64), 64);
  writer.bytes += name;
  for (const StoredTile& tile : header.tiles) put_row(writer, tile);
  const std::uint64_t bytes = writer.bytes.size();
  writer.put(checksum_of(std::as_bytes(std::span(writer.bytes))));
  writer.put(bytes);
  return std::move(writer.bytes);
}

std::uint64_t place_tiles(PointStoreHeader& header) {
  std::uint64_t next = beginning_bytes;
  for (StoredTile& tile : header.tiles) {
    tile.byte_offset = next;
    next += tile_bytes(tile.code);
  }
  return next;
}

bool is_store_of_other_version(std::span<const std::byte> file) {
  const std::string beginning = store_beginning();
  return file.size() >= beginning.size() && std::memcmp(file.data(), mark, sizeof mark) == 0 &&
         std::memcmp(file.data(), beginning.data(), beginning.size()) != 0;
}

std::optional<PointStoreHeader> parsed_header(std::span<const std::byte> file) {
  const auto part = header_part(file);
  if (part.empty()) return std::nullopt;
  Reader reader(part);
  std::uint64_t tiles = 0;
  std::optional<PointStoreHeader> header = parsed_fixed_part(reader, tiles, part.size());
  if (!header) return std::nullopt;
  std::uint64_t points = 0;
  for (std::uint64_t t = 0; t < tiles; ++t) {
    header->tiles.push_back(row_of(reader));
    if (!is_sound(header->tiles.back(), points)) return std::nullopt;
    points += header->tiles.back().code.count;
  }
  if (points != header->points || place_tiles(*header) != file.size() - end_bytes - part.size()) return std::nullopt;
  return header;
}

}  // namespace adit::io
