#pragma once
// A scan on disk after import: tiles in even order, memory-mapped, checksummed. Written by StoreWriter.

#include <Eigen/Core>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/geometry/tile_source.h"
#include "io/mapped_file.h"
#include "io/point_store_header.h"

namespace adit::io {

/// A store as a source of tiles. All functions may be called from several threads at once.
class PointStore : public TileSource {
 public:
  /// Error "damaged; run the import again" unless header, table and size of the file agree to the last bit.
  explicit PointStore(const std::filesystem::path& path);

  /// What the store says of itself.
  const PointStoreHeader& header() const { return header_; }
  const std::string& name() const { return header_.name; }
  /// File coordinates = stored point + offset.
  const Eigen::Vector3d& offset() const { return header_.offset; }
  const std::optional<Pose>& file_pose() const { return header_.file_pose; }
  const std::string& source_sha256() const { return header_.source_sha256; }
  std::uint64_t no_returns() const { return header_.no_returns; }
  std::uint64_t points() const { return header_.points; }

  /// Reads every tile once. Error as the constructor when one is damaged.
  void expect_intact(const Progress& progress) const;

  std::size_t tile_count() const override { return header_.tiles.size(); }
  std::size_t point_count(std::size_t tile) const override { return header_.tiles.at(tile).code.count; }
  BoundingBox box(std::size_t tile) const override;
  /// A prefix within the overview (the first 64th) is checked against the overview's checksum and touches no more of
  /// the file; anything longer against the whole tile's. Each is checked once. Error as the constructor. The pages of a
  /// tile that was read whole do not stay resident.
  PointCloud read(std::size_t tile, std::size_t prefix = all_points) const override;
  std::vector<Eigen::Vector3f> positions(std::size_t tile, std::size_t prefix = all_points) const override;

 private:
  void expect_intact(std::size_t tile, std::size_t prefix) const;
  PointCloud decoded(std::size_t tile, std::size_t prefix, WantedColumns wanted) const;

  std::filesystem::path path_;
  MappedFile file_;
  PointStoreHeader header_;
  /// Per tile: 1 the overview is known to be intact, 2 the whole tile.
  mutable std::unique_ptr<std::atomic<int>[]> checked_;
};

}  // namespace adit::io
