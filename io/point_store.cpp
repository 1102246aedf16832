#include "io/point_store.h"

#include <algorithm>
#include <utility>

#include "core/foundation/error.h"
#include "core/foundation/parallel.h"

namespace adit::io {
namespace {

PointStoreHeader header_or_error(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::optional<PointStoreHeader> header = parsed_header(bytes);
  if (header) return *std::move(header);
  if (is_store_of_other_version(bytes))
    throw Error("the stored scan was written by another version of Adit", path.string(), "run the import again");
  throw Error("the stored scan is damaged", path.string(), "run the import again");
}

}  // namespace

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
  const bool overview_will_do = prefix <= overview_points(row.code.count);
  const int wanted = overview_will_do ? 1 : 2;
  if (checked_[tile].load(std::memory_order_acquire) >= wanted) return;
  const std::byte* bytes = file_.bytes().data() + row.byte_offset;
  const bool intact = overview_will_do
                          ? prefix_checksum(row.code, bytes, overview_points(row.code.count)) == row.overview_checksum
                          : prefix_checksum(row.code, bytes, row.code.count) == row.checksum;
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
        const StoredTile& row = header_.tiles[tile];
        expect_intact(tile, row.code.count);
        file_.release(row.byte_offset, tile_bytes(row.code));
      },
      1);
}

PointCloud PointStore::decoded(std::size_t tile, std::size_t prefix, WantedColumns wanted) const {
  const StoredTile& row = header_.tiles.at(tile);
  const std::size_t count = std::min<std::size_t>(prefix, row.code.count);
  if (count == 0) return {};
  expect_intact(tile, count);
  PointCloud cloud = decoded_tile(row.code, file_.bytes().data() + row.byte_offset, count, header_.keep, wanted);
  if (count == row.code.count) file_.release(row.byte_offset, tile_bytes(row.code));
  return cloud;
}

PointCloud PointStore::read(std::size_t tile, std::size_t prefix) const {
  return decoded(tile, prefix, {header_.has_intensity, header_.has_colour});
}

std::vector<Eigen::Vector3f> PointStore::positions(std::size_t tile, std::size_t prefix) const {
  return std::move(decoded(tile, prefix, {}).points);
}

}  // namespace adit::io
