#include "io/store_writer.h"

#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "core/foundation/error.h"
#include "core/geometry/morton.h"
#include "io/scan_from_memory.h"
#include "io/scan_offset.h"

namespace adit::io {
namespace {

constexpr std::size_t tiles_at_once = 16;

struct WrittenTile {
  StoredTile row;
  std::vector<std::byte> bytes;
};

std::array<float, 6> box_of(const StoredPoints& points, Keep keep) {
  Eigen::AlignedBox3f box;
  if (keep == Keep::float32) {
    for (const StoredPosition& p : points.positions) box.extend(position_of(p, keep));
  } else {
    // Whole numbers are compared faster than the metres they stand for.
    Eigen::AlignedBox3i steps;
    for (const StoredPosition& p : points.positions) steps.extend(Eigen::Vector3i(p[0], p[1], p[2]));
    const auto corner = [&](const Eigen::Vector3i& c) { return position_of({c.x(), c.y(), c.z()}, keep); };
    box = {corner(steps.min()), corner(steps.max())};
  }
  return {box.min().x(), box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z()};
}

WrittenTile written_tile(const StoredPoints& points, std::span<const std::uint32_t> order, Keep keep) {
  EncodedTile encoded = encoded_tile(points, order, keep);
  WrittenTile tile;
  tile.row.code = encoded.code;
  tile.row.box = box_of(points, keep);
  tile.row.overview_checksum = prefix_checksum(encoded.code, encoded.bytes.data(), overview_points(points.size()));
  tile.row.checksum = prefix_checksum(encoded.code, encoded.bytes.data(), points.size());
  tile.bytes = std::move(encoded.bytes);
  return tile;
}

/// Points [n t / tiles, n (t + 1) / tiles) are those of tile t.
std::uint64_t tile_begin(std::uint64_t points, std::size_t tiles, std::size_t t) {
  const std::uint64_t each = points / tiles;
  return each * t + points % tiles * t / tiles;
}

}  // namespace

StoreWriter::StoreWriter(std::filesystem::path path, StoreOptions options)
    : path_(std::move(path)), options_(std::move(options)), spool_(path_.parent_path()) {
  header_.name = options_.name;
  header_.source_sha256 = options_.source_sha256;
  header_.source_scan = options_.scan;
  header_.keep = options_.keep;
}

StoreWriter::~StoreWriter() noexcept {
  sorting_.cancel();
  try {
    sorting_.wait();
  } catch (...) {
    // the Error that ended the run is on its way already
  }
}

bool StoreWriter::begin(const ScanHeader& scan) {
  scans_seen_.push_back(scan.name);
  const std::uint64_t number = scans_seen_.size();
  if (options_.scan == 0 ? number > 1 : number != options_.scan) return false;
  expect_metres(scan);
  taken_ = true;
  where_ = scan.where;
  header_.file_pose = scan.file_pose;
  header_.has_intensity = scan.attributes.intensity;
  header_.has_colour = scan.attributes.colour;
  return true;
}

void StoreWriter::take(PointBlock& block) {
  if (first_block_) header_.offset = offset_for(block.positions, where_);
  first_block_ = false;
  BoundingBox box;
  for (const Eigen::Vector3d& p : block.positions) box.extend(p);
  expect_near_offset(box, header_.offset, where_);
  watch_ranges(block, box);
  add(block);
  if (filling_.size() >= options_.run_points) close_run();
}

void StoreWriter::watch_ranges(const PointBlock& block, const BoundingBox& box) {
  if (!options_.drop_no_returns || !header_.offset.isZero(0.0)) return;
  const double farthest_m = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm() + stored_step_m;
  if (shell_.is_clear_of(farthest_m)) {
    shell_.pass(block.size());
    return;
  }
  for (const Eigen::Vector3d& p : block.positions)
    shell_.add(position_of(stored_position(p, header_.keep), header_.keep));
}

void StoreWriter::add(const PointBlock& block) {
  points_ += block.size();
  const auto first = static_cast<std::uint32_t>(filling_.size());
  const std::span<CurvePoint> places = filling_.add(block.size());
  const Keep keep = header_.keep;
  const Eigen::Vector3d offset = header_.offset;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const StoredPosition stored = stored_position(block.positions[i] - offset, keep);
    places[i] = {curve_key(stored, keep), stored, first + i};
  }
  // Zero has one sign, so that equal points are equal to the bit.
  for (const float value : block.intensity) filling_.intensity.push_back(value + 0.0F);
  filling_.colour.insert(filling_.colour.end(), block.colour.begin(), block.colour.end());
}

/// Sorts what has come, beside the reader.
void StoreWriter::close_run() {
  sorting_.wait();
  std::swap(filling_, sorting_points_);
  filling_.clear();
  sorting_.run([this] { runs_.push_back(spooled_run(sorter_.sorted(sorting_points_), spool_)); });
}

void StoreWriter::end(std::uint64_t no_returns) {
  header_.no_returns += no_returns;
}

void StoreWriter::expect_the_scan() const {
  if (options_.scan == 0 && scans_seen_.size() > 1)
    throw Error("the file holds " + std::to_string(scans_seen_.size()) + " scans and none of them is chosen", where_,
                "name one with its number");
  if (!taken_)
    throw Error(
        "there is no scan " + std::to_string(options_.scan) + "; the file holds " + std::to_string(scans_seen_.size()),
        path_.string(), "choose another");
}

void StoreWriter::write(Progress& progress) {
  expect_the_scan();
  const std::uint64_t dropped = shell_.count();
  header_.points = points_ - dropped;
  header_.no_returns += dropped;
  if (header_.points == 0)
    throw Error("no point is left after taking out pulses without echo", where_, "check the export");
  sorting_.wait();
  progress.check();
  sorting_points_ = {};
  if (filling_.size() > 0) runs_.push_back(run_of(std::move(sorter_.sorted(filling_))));
  filling_ = {};
  sorter_ = {};
  write_tiles(std::move(runs_), progress);
}

void StoreWriter::commit() {
  written_.value().commit();
  written_.reset();
}

void StoreWriter::write_tiles(std::vector<SortedRun> runs, Progress& progress) {
  const Keep keep = header_.keep;
  const auto tiles = static_cast<std::size_t>((header_.points + store_tile_points - 1) / store_tile_points);
  const float limit_m = shell_.begins_at_m();
  const auto is_kept = [&](const StoredPosition& p) {
    return limit_m == std::numeric_limits<float>::infinity() || position_of(p, keep).norm() < limit_m;
  };
  MergedRuns merged(std::move(runs), spool_, keep);
  AtomicFile& file = written_.emplace(path_);
  file.append(store_beginning());
  // Tiles differ in length by one point at the most.
  const auto least_points = static_cast<std::uint32_t>(header_.points / tiles);
  const std::array<std::vector<std::uint32_t>, 2> orders = {even_prefix_order(least_points),
                                                            even_prefix_order(least_points + 1)};
  std::size_t next = 0;
  const auto next_tile = [&](tbb::flow_control& control) {
    auto points = std::make_shared<StoredPoints>();
    if (next == tiles) {
      control.stop();
      return points;
    }
    progress.step(next, tiles);
    const std::uint64_t begin = tile_begin(header_.points, tiles, next);
    merged.fill(static_cast<std::size_t>(tile_begin(header_.points, tiles, ++next) - begin), *points, is_kept);
    return points;
  };
  const auto append = [&](const std::shared_ptr<WrittenTile>& tile) {
    const auto before = header_.tiles.empty() ? 0 : header_.tiles.back().first_point + header_.tiles.back().code.count;
    tile->row.first_point = before;
    header_.tiles.push_back(tile->row);
    file.append(tile->bytes);
  };
  tbb::parallel_pipeline(
      tiles_at_once,
      tbb::make_filter<void, std::shared_ptr<StoredPoints>>(tbb::filter_mode::serial_in_order, next_tile) &
          tbb::make_filter<std::shared_ptr<StoredPoints>, std::shared_ptr<WrittenTile>>(
              tbb::filter_mode::parallel,
              [&](const std::shared_ptr<StoredPoints>& points) {
                return std::make_shared<WrittenTile>(
                    written_tile(*points, orders.at(points->size() - least_points), keep));
              }) &
          tbb::make_filter<std::shared_ptr<WrittenTile>, void>(tbb::filter_mode::serial_in_order, append));
  file.append(store_end(header_));
}

void write_point_store(const std::filesystem::path& path, const ScanData& scan, const StoreOptions& options,
                       Progress& progress) {
  StoreWriter writer(path, options);
  stream_from_memory(scan, path, writer, progress);
  writer.write(progress);
  writer.commit();
}

}  // namespace adit::io
