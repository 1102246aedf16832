#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/atomic_file.h"
#include "io/outgoing_scan.h"
#include "io/ptx.h"
#include "io/text_line.h"

namespace adit::io {
namespace {

constexpr std::size_t points_between_checks = 8192;
constexpr int decimals = 5;  // a hundredth of a millimetre

std::string numbers_line(const Eigen::RowVectorXd& numbers) {
  TextLine line;
  for (const double value : numbers) line.add(short_number(value));
  return line.ended();
}

std::string header_text(std::size_t points, const Pose& pose) {
  const Eigen::Matrix4d rows = pose.matrix().transpose();  // PTX multiplies rows
  std::string text = "1\n" + std::to_string(points) + "\n" + numbers_line(rows.row(3).head<3>());
  for (Eigen::Index i = 0; i < 3; ++i) text += numbers_line(rows.row(i).head<3>());
  for (Eigen::Index i = 0; i < 4; ++i) text += numbers_line(rows.row(i));
  return text;
}

void append_scan(AtomicFile& file, const OutgoingScan& scan, const Progress& progress) {
  const PointCloud& cloud = scan.cloud();
  const IntensityRange range = intensity_range(cloud, 1.0, false);
  TextLine line;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    line.clear();
    if (scan.is_float32())
      for (const float c : cloud.points[i]) line.add(c);
    else
      for (const double c : scan.position(i)) line.add(c, decimals);
    line.add(cloud.has_intensity() ? static_cast<float>(range(cloud.intensity[i])) : 0.5F);
    if (cloud.has_colour())
      for (const std::uint8_t c : cloud.colour[i]) line.add(unsigned{c});
    file.append(line.ended());
  }
}

}  // namespace

void write_ptx(const std::filesystem::path& path, const std::vector<ScanData>& scans, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {}, path);
  if (scans.empty()) throw Error("there is no scan to write", path.string(), "choose at least one scan");
  AtomicFile file(path);
  for (const ScanData& scan_data : scans) {
    const OutgoingScan scan(scan_data, PoseGoes::beside_points, path);
    Progress part = progress.part(1.0 / static_cast<double>(scans.size()), scan_data.name);
    file.append(header_text(scan.size(), scan_data.file_pose.value_or(Pose::Identity())));
    append_scan(file, scan, part);
  }
  file.commit();
}

}  // namespace adit::io
