#include "io/pts.h"

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/outgoing_scan.h"
#include "io/point_stream.h"
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
  return {values == 4 || values == 7, values >= 6, false, false};
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
void stream_block(LineReader& lines, const std::string& name, const ReadOptions& options, ScanSink& sink,
                  const Progress& progress) {
  const std::vector<Field>& first = lines.fields_between_blanks();
  if (first.size() != 1)
    lines.fail("the number of points is needed alone on a line", "put it there, or name a file without it .xyz");
  const std::uint64_t count = lines.count(first[0]);
  lines.file().expect_records(lines.position(), count, least_line_bytes, "points");
  const std::string where = lines.place();
  if (count == 0) throw Error("the scan holds no points", where, "export the scan again with its points");
  const std::size_t values = next_point(lines, 0, count).size();
  PointStream out({name, where, attributes_of(lines, values), std::nullopt, count, {}}, options, NanMeans::invalid,
                  sink);
  FilePoint point;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    const std::vector<Field>& fields = i == 0 ? lines.fields_between_blanks() : next_point(lines, i, count);
    if (fields.size() != values)
      lines.fail("the line has " + std::to_string(fields.size()) + " values, the first one " + std::to_string(values),
                 "export the file again");
    if (!out.wanted()) continue;
    take(lines, fields, point);
    out.add(point, [&] { return lines.place(); });
  }
  out.end();
}

}  // namespace

void stream_pts(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  LineReader lines(path);
  int scans = 0;
  while (lines.next_with_text()) {
    if (scans > 0 && lines.fields_between_blanks().size() != 1)
      lines.fail("there are more points than the number above them says", "correct that number");
    stream_block(lines, name_of_scan(path, ++scans), options, sink, progress);
  }
  if (scans == 0) lines.fail("the file holds no points", "export the scan again with its points");
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
