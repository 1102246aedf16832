#include "io/scan_collector.h"

#include "io/scan_offset.h"

namespace adit::io {
namespace {

template <typename T>
void append(std::vector<T>& values, const std::vector<T>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

}  // namespace

bool ScanCollector::begin(const ScanHeader& scan) {
  header_ = scan;
  scans.emplace_back();
  scans.back().name = scan.name;
  scans.back().file_pose = scan.file_pose;
  return true;
}

void ScanCollector::take(PointBlock& block) {
  ScanData& scan = scans.back();
  if (scan.cloud.empty()) scan.offset = offset_for(block.positions, header_.where);
  BoundingBox box;
  for (const Eigen::Vector3d& p : block.positions) {
    box.extend(p);
    scan.cloud.points.emplace_back((p - scan.offset).cast<float>());
  }
  expect_near_offset(box, scan.offset, header_.where);
  append(scan.cloud.intensity, block.intensity);
  append(scan.cloud.colour, block.colour);
  append(scan.cloud.normals, block.normals);
}

void ScanCollector::end(std::uint64_t no_returns) {
  scans.back().no_returns = no_returns;
}

}  // namespace adit::io
