#include "io/outgoing_scan.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"

namespace adit::io {

OutgoingScan::OutgoingScan(const ScanData& scan, PoseGoes pose_goes, const std::filesystem::path& file) : scan_(scan) {
  const PointCloud& cloud = scan.cloud;
  const auto fits = [&](std::size_t length) { return length == 0 || length == cloud.size(); };
  if (cloud.empty()) throw Error("a scan without points cannot be written", file.string(), "choose a scan with points");
  if (!fits(cloud.intensity.size()) || !fits(cloud.colour.size()) || !fits(cloud.normals.size()))
    throw Error("an attribute has another length than the points", file.string(), "read the scan again");
  for (const Eigen::Vector3f& p : cloud.points)
    if (!p.allFinite())
      throw Error("a point to be written is not finite", file.string(), "read the scan without invalid points");
  if (scan.file_pose && pose_goes == PoseGoes::into_points) {
    moved_ = true;
    pose_ = *scan.file_pose;
  }
}

BoundingBox OutgoingScan::box() const {
  BoundingBox box;
  for (std::size_t i = 0; i < size(); ++i) box.extend(position(i));
  return box;
}

IntensityRange intensity_range(const PointCloud& cloud, double most, bool whole) {
  if (cloud.intensity.empty()) return {};
  const auto [least, greatest] = std::minmax_element(cloud.intensity.begin(), cloud.intensity.end());
  const double low = static_cast<double>(*least);
  const double high = static_cast<double>(*greatest);
  const bool all_whole = std::all_of(cloud.intensity.begin(), cloud.intensity.end(),
                                     [](float value) { return value == std::floor(value); });
  if (low >= 0.0 && high <= most && (!whole || all_whole)) return {};
  if (low >= 0.0 && high <= 1.0) return {0.0, most};
  return {low, high > low ? most / (high - low) : 1.0};
}

void expect_variant(const WriteOptions& options, const std::vector<std::string>& known,
                    const std::filesystem::path& file) {
  if (options.variant.empty() || std::find(known.begin(), known.end(), options.variant) != known.end()) return;
  std::string list;
  for (const std::string& word : known) list += (list.empty() ? "" : ", ") + word;
  throw Error("the format has no variant \"" + options.variant + "\"", file.string(),
              list.empty() ? "leave the variant out" : "choose one of " + list);
}

}  // namespace adit::io
