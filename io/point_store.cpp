#include "io/point_store.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"
#include "io/atomic_file.h"

namespace adit::io {
namespace {

/// The first `prefix` points of tile as a cloud.
PointCloud unpacked(const PointStoreHeader& header, std::span<const std::byte> tile, std::size_t count,
                    std::size_t prefix) {
  const TileLayout layout = tile_layout(header, count);
  PointCloud cloud;
  cloud.points.resize(prefix);
  std::memcpy(static_cast<void*>(cloud.points.data()), tile.data(), 12 * prefix);
  if (header.has_intensity) {
    cloud.intensity.resize(prefix);
    std::memcpy(cloud.intensity.data(), tile.data() + layout.intensity, 4 * prefix);
  }
  if (header.has_colour) {
    cloud.colour.resize(prefix);
    std::memcpy(cloud.colour.data(), tile.data() + layout.colour, 3 * prefix);
  }
  return cloud;
}

/// Points begin .. begin + count of a cloud as the bytes of a tile.
std::vector<std::byte> packed(const PointStoreHeader& header, const PointCloud& cloud, std::size_t begin,
                              std::size_t count) {
  const TileLayout layout = tile_layout(header, count);
  std::vector<std::byte> bytes(layout.bytes);
  std::memcpy(bytes.data(), static_cast<const void*>(cloud.points.data() + begin), 12 * count);
  if (header.has_intensity) std::memcpy(bytes.data() + layout.intensity, cloud.intensity.data() + begin, 4 * count);
  if (header.has_colour) std::memcpy(bytes.data() + layout.colour, cloud.colour.data() + begin, 3 * count);
  return bytes;
}

StoredTile described(const PointStoreHeader& header, const TiledCloud& tiled_cloud, std::size_t t) {
  StoredTile tile;
  tile.first_point = tiled_cloud.tile_begin[t];
  tile.count = static_cast<std::uint32_t>(tiled_cloud.tile_begin[t + 1] - tiled_cloud.tile_begin[t]);
  Eigen::AlignedBox3f box;
  for (std::size_t i = tiled_cloud.tile_begin[t]; i < tiled_cloud.tile_begin[t + 1]; ++i)
    box.extend(tiled_cloud.cloud.points[i]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    tile.box[axis] = box.min()[static_cast<Eigen::Index>(axis)];
    tile.box[axis + 3] = box.max()[static_cast<Eigen::Index>(axis)];
  }
  const auto bytes = packed(header, tiled_cloud.cloud, tile.first_point, tile.count);
  tile.overview_checksum = tile_checksum(header, bytes, tile.count, overview_points(tile.count));
  tile.checksum = tile_checksum(header, bytes, tile.count, tile.count);
  return tile;
}

PointStoreHeader described(const ScanData& scan, const std::string& source_sha256) {
  PointStoreHeader header;
  header.name = scan.name;
  header.offset = scan.offset;
  header.file_pose = scan.file_pose;
  header.source_sha256 = source_sha256;
  header.points = scan.cloud.size();
  header.no_returns = scan.no_returns;
  header.has_intensity = scan.cloud.has_intensity();
  header.has_colour = scan.cloud.has_colour();
  return header;
}

PointStoreHeader header_or_error(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::optional<PointStoreHeader> header = parsed_header(bytes);
  if (!header) throw Error("the stored scan is damaged", path.string(), "run the import again");
  return *std::move(header);
}

}  // namespace

void write_point_store(const std::filesystem::path& path, ScanData scan, const std::string& source_sha256,
                       Progress& progress) {
  if (scan.cloud.empty()) throw Error("a scan without points cannot be stored", path.string(), "check the scan");
  PointStoreHeader header = described(scan, source_sha256);
  scan.cloud.normals = {};
  progress.check();
  const TiledCloud tiled_cloud = tiled(std::move(scan.cloud), store_tile_points);
  const std::size_t tiles = tiled_cloud.tile_begin.size() - 1;
  for (std::size_t t = 0; t < tiles; ++t) {
    progress.step(t, 2 * tiles);
    header.tiles.push_back(described(header, tiled_cloud, t));
  }
  AtomicFile file(path);
  file.append(header_bytes(header));
  for (std::size_t t = 0; t < tiles; ++t) {
    progress.step(tiles + t, 2 * tiles);
    file.append(packed(header, tiled_cloud.cloud, header.tiles[t].first_point, header.tiles[t].count));
  }
  file.commit();
}

PointStore::PointStore(const std::filesystem::path& path)
    : path_(path),
      file_(path),
      header_(header_or_error(path, file_.bytes())),
      checked_(std::make_unique<std::atomic<int>[]>(header_.tiles.size())) {}

BoundingBox PointStore::box(std::size_t tile) const {
  const std::array<float, 6>& b = header_.tiles.at(tile).box;
  return BoundingBox(Eigen::Vector3f(b[0], b[1], b[2]).cast<double>(),
                     Eigen::Vector3f(b[3], b[4], b[5]).cast<double>());
}

void PointStore::expect_intact(std::size_t tile, std::size_t prefix) const {
  const StoredTile& row = header_.tiles[tile];
  const bool overview_will_do = prefix <= overview_points(row.count);
  const int wanted = overview_will_do ? 1 : 2;
  if (checked_[tile].load(std::memory_order_acquire) >= wanted) return;
  const auto bytes = file_.bytes().subspan(row.byte_offset);
  const bool intact =
      overview_will_do ? tile_checksum(header_, bytes, row.count, overview_points(row.count)) == row.overview_checksum
                       : tile_checksum(header_, bytes, row.count, row.count) == row.checksum;
  if (!intact)
    throw Error("tile " + std::to_string(tile) + " of the stored scan is damaged",
                path_.string() + ": byte " + std::to_string(row.byte_offset), "run the import again");
  int before = checked_[tile].load(std::memory_order_relaxed);
  while (before < wanted && !checked_[tile].compare_exchange_weak(before, wanted)) {
  }
}

void PointStore::expect_intact(const Progress& progress) const {
  parallel_for_each_index(
      tile_count(),
      [&](std::size_t tile) {
        progress.check();
        expect_intact(tile, header_.tiles[tile].count);
      },
      1);
}

PointCloud PointStore::read(std::size_t tile, std::size_t prefix) const {
  const StoredTile& row = header_.tiles.at(tile);
  const std::size_t wanted = std::min<std::size_t>(prefix, row.count);
  if (wanted == 0) return {};
  expect_intact(tile, wanted);
  return unpacked(header_, file_.bytes().subspan(row.byte_offset), row.count, wanted);
}

}  // namespace adit::io
