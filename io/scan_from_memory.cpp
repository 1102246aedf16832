#include "io/scan_from_memory.h"

#include <algorithm>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr std::size_t points_at_once = 8192;

ScanHeader header_of(const ScanData& scan, const std::filesystem::path& file) {
  ScanHeader header;
  header.name = scan.name;
  header.where = file.string();
  header.attributes = {scan.cloud.has_intensity(), scan.cloud.has_colour(), scan.cloud.has_normals(), false};
  header.file_pose = scan.file_pose;
  header.points = scan.cloud.size();
  return header;
}

void expect_whole(const PointCloud& cloud, const std::filesystem::path& file) {
  const auto fits = [&](std::size_t length) { return length == 0 || length == cloud.size(); };
  if (cloud.empty()) throw Error("a scan without points cannot be written", file.string(), "choose a scan with points");
  if (!fits(cloud.intensity.size()) || !fits(cloud.colour.size()) || !fits(cloud.normals.size()))
    throw Error("an attribute has another length than the points", file.string(), "read the scan again");
}

template <typename T>
void copy_part(const std::vector<T>& from, std::size_t begin, std::size_t end, std::vector<T>& to) {
  if (from.empty()) return;
  to.assign(from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end));
}

}  // namespace

void stream_from_memory(const ScanData& scan, const std::filesystem::path& file, ScanSink& sink,
                        const Progress& progress) {
  const PointCloud& cloud = scan.cloud;
  expect_whole(cloud, file);
  if (!sink.begin(header_of(scan, file))) return;
  PointBlock block;
  for (std::size_t begin = 0; begin < cloud.size(); begin += points_at_once) {
    progress.step(begin, cloud.size());
    const std::size_t end = std::min(begin + points_at_once, cloud.size());
    block.clear();
    for (std::size_t i = begin; i < end; ++i) {
      if (!cloud.points[i].allFinite())
        throw Error("a point to be written is not finite", file.string(), "read the scan without invalid points");
      block.positions.emplace_back(cloud.points[i].cast<double>() + scan.offset);
    }
    copy_part(cloud.intensity, begin, end, block.intensity);
    copy_part(cloud.colour, begin, end, block.colour);
    copy_part(cloud.normals, begin, end, block.normals);
    sink.take(block);
  }
  sink.end(scan.no_returns);
}

}  // namespace adit::io
