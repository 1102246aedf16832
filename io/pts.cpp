#include "io/pts.h"

#include "io/atomic_file.h"
#include "io/cloud_builder.h"
#include "io/outgoing_scan.h"
#include "io/text_line.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;
constexpr std::uint64_t least_line_bytes = 5;  // "0 0 0"; the last line may lack its end
constexpr int decimals = 5;                    // a hundredth of a millimetre

Attributes attributes_of(const LineReader& lines, std::size_t values) {
  if (values != 3 && values != 4 && values != 6 && values != 7)
    lines.fail("a point of " + std::to_string(values) + " values", "write x y z, then intensity, then red green blue");
  return {values == 4 || values == 7, values >= 6, false};
}

void take(const LineReader& lines, const std::vector<Field>& fields, FilePoint& point) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.position[static_cast<Eigen::Index>(axis)] = lines.number_or_nan(fields[axis]);
  if (fields.size() == 4 || fields.size() == 7)
    point.intensity = static_cast<float>(lines.number_or_nan(fields[3], "the intensity"));
  if (fields.size() >= 6)
    for (std::size_t c = 0; c < 3; ++c) point.colour[c] = lines.byte(fields[fields.size() - 3 + c]);
}

const std::vector<Field>& next_point(LineReader& lines, std::uint64_t done, std::uint64_t count) {
  if (!lines.next_with_text())
    lines.fail("the header says " + std::to_string(count) + " points, the file ends after " + std::to_string(done),
               "the file is cut short; copy or export it again");
  return lines.fields_between_blanks();
}

/// The points below the count on the present line.
ScanData read_block(LineReader& lines, const std::string& name, const ReadOptions& options, const Progress& progress) {
  const std::vector<Field>& first = lines.fields_between_blanks();
  if (first.size() != 1)
    lines.fail("the number of points is needed alone on a line", "put it there, or name a file without it .xyz");
  const std::uint64_t count = lines.count(first[0]);
  lines.file().expect_records(lines.position(), count, least_line_bytes, "points");
  const std::string where = lines.place();
  std::size_t values = 0;
  CloudBuilder builder({}, options);
  FilePoint point;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    const std::vector<Field>& fields = next_point(lines, i, count);
    if (i == 0) {
      values = fields.size();
      builder = CloudBuilder(attributes_of(lines, values), options);
      builder.expect(count);
    }
    if (fields.size() != values)
      lines.fail("the line has " + std::to_string(fields.size()) + " values, the first one " + std::to_string(values),
                 "export the file again");
    take(lines, fields, point);
    builder.add(point, [&] { return lines.place(); });
  }
  return builder.finished(name, where, progress);
}

}  // namespace

std::vector<ScanData> read_pts(const std::filesystem::path& path, const ReadOptions& options, Progress& progress) {
  LineReader lines(path);
  std::vector<ScanData> scans;
  while (lines.next_with_text()) {
    if (!scans.empty() && lines.fields_between_blanks().size() != 1)
      lines.fail("there are more points than the number above them says", "correct that number");
    scans.push_back(
        read_block(lines, path.stem().string() + "-" + std::to_string(scans.size() + 1), options, progress));
  }
  if (scans.empty()) lines.fail("the file holds no points", "export the scan again with its points");
  if (scans.size() == 1) scans[0].name = path.stem().string();
  return scans;
}

void write_pts(const std::filesystem::path& path, const ScanData& scan_data, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {}, path);
  const OutgoingScan scan(scan_data, PoseGoes::into_points, path);
  const PointCloud& cloud = scan.cloud();
  AtomicFile file(path);
  file.append(std::to_string(scan.size()) + "\n");
  TextLine line;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    line.clear();
    if (scan.is_float32())
      for (const float c : cloud.points[i]) line.add(c);
    else
      for (const double c : scan.position(i)) line.add(c, decimals);
    if (cloud.has_intensity()) line.add(cloud.intensity[i]);
    if (cloud.has_colour())
      for (const std::uint8_t c : cloud.colour[i]) line.add(unsigned{c});
    file.append(line.ended());
  }
  file.commit();
}

}  // namespace adit::io
