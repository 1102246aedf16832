#pragma once
// Scans as they come out of a stream and go into a writer, kept whole, in double, with their raster.

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "io/scan_writer.h"
#include "tests/io/scan_samples.h"

namespace adit::tests {

struct StreamedScan {
  io::ScanHeader header;
  io::PointBlock points;
  std::uint64_t no_returns = 0;
};

/// Keeps all scans but those it does not want (their numbers, from 0).
class Recorder : public io::ScanSink {
 public:
  bool begin(const io::ScanHeader& scan) override {
    if (unwanted.contains(begun_++)) return false;
    scans.push_back({scan, {}, 0});
    return true;
  }
  void take(io::PointBlock& block) override {
    EXPECT_LE(block.size(), io::PointBlock::most_points);
    io::PointBlock& all = scans.back().points;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.positions, block.positions);
    append(all.intensity, block.intensity);
    append(all.colour, block.colour);
    append(all.normals, block.normals);
    append(all.grid, block.grid);
  }
  void end(std::uint64_t no_returns) override { scans.back().no_returns = no_returns; }

  std::set<int> unwanted;
  std::vector<StreamedScan> scans;

 private:
  int begun_ = 0;
};

inline std::vector<StreamedScan> stream_all(const std::filesystem::path& file, const io::ReadOptions& options = {}) {
  Recorder recorder;
  Progress progress;
  io::stream_scans(file, options, recorder, progress);
  return recorder.scans;
}

/// n points of sample_scan() with every attribute, in a raster of 7 rows.
inline StreamedScan sample_stream(std::size_t n, const std::string& name = "sample") {
  const io::ScanData sample = sample_scan(n);
  StreamedScan scan;
  scan.header.name = name;
  scan.header.attributes = {true, true, true, true};
  for (std::size_t i = 0; i < n; ++i) {
    scan.points.positions.push_back(sample.cloud.points[i].cast<double>());
    scan.points.grid.push_back({static_cast<std::uint32_t>(i % 7), static_cast<std::uint32_t>(i / 7)});
  }
  scan.points.intensity = sample.cloud.intensity;
  scan.points.colour = sample.cloud.colour;
  scan.points.normals = sample.cloud.normals;
  return scan;
}

/// The scan with these attributes alone.
inline StreamedScan only(StreamedScan scan, const io::Attributes& wanted) {
  scan.header.attributes = wanted;
  if (!wanted.intensity) scan.points.intensity.clear();
  if (!wanted.colour) scan.points.colour.clear();
  if (!wanted.normals) scan.points.normals.clear();
  if (!wanted.grid) scan.points.grid.clear();
  return scan;
}

/// Hands the scan on in blocks.
inline void hand_out(const StreamedScan& scan, io::ScanSink& sink) {
  ASSERT_TRUE(sink.begin(scan.header));
  for (std::size_t from = 0; from < scan.points.size(); from += io::PointBlock::most_points) {
    const std::size_t to = std::min(scan.points.size(), from + io::PointBlock::most_points);
    io::PointBlock block;
    const auto part = [&](auto& into, const auto& all) {
      if (!all.empty())
        into.assign(all.begin() + static_cast<std::ptrdiff_t>(from), all.begin() + static_cast<std::ptrdiff_t>(to));
    };
    part(block.positions, scan.points.positions);
    part(block.intensity, scan.points.intensity);
    part(block.colour, scan.points.colour);
    part(block.normals, scan.points.normals);
    part(block.grid, scan.points.grid);
    sink.take(block);
  }
  sink.end(scan.no_returns);
}

using MakeWriter = std::unique_ptr<io::ScanWriter> (*)(const std::filesystem::path&, const std::vector<io::ScanFacts>&,
                                                       const io::WriteOptions&);

inline void write_streams(MakeWriter make_writer, const std::filesystem::path& file,
                          const std::vector<StreamedScan>& scans, const std::string& variant = {}) {
  io::FactsSink facts;
  for (const StreamedScan& scan : scans) hand_out(scan, facts);
  const std::unique_ptr<io::ScanWriter> writer = make_writer(file, facts.scans, {variant});
  for (const StreamedScan& scan : scans) hand_out(scan, *writer);
  writer->commit();
}

/// Largest distance between points of the same index [m].
inline double largest_distance_m(const StreamedScan& a, const StreamedScan& b) {
  if (a.points.size() != b.points.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.points.size(); ++i)
    largest = std::max(largest, (a.points.positions[i] - b.points.positions[i]).norm());
  return largest;
}

}  // namespace adit::tests
