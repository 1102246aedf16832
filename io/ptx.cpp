#include "io/ptx.h"

#include <cmath>

#include "io/cloud_builder.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;
constexpr std::uint64_t least_line_bytes = 5;  // "0 0 0"; the last line may lack its end
constexpr std::uint64_t most_on_a_side = 1'000'000'000;
constexpr double rigid_to = 1e-3;

void next_header_line(LineReader& lines) {
  if (!lines.next_with_text())
    lines.fail("the file ends inside the header of a scan", "the file is cut short; copy or export it again");
}

std::uint64_t side(LineReader& lines, const std::string& what) {
  const std::vector<Field>& fields = lines.fields_between_blanks();
  if (fields.size() != 1) lines.fail("the number of " + what + " is needed alone on a line", "export the file again");
  const std::uint64_t count = lines.count(fields[0]);
  if (count > most_on_a_side) lines.fail("a grid cannot have so many " + what, "export the file again");
  return count;
}

/// Finite numbers of the next line; exactly `count` of them.
Eigen::RowVector4d header_numbers(LineReader& lines, std::size_t count) {
  next_header_line(lines);
  const std::vector<Field>& fields = lines.fields_between_blanks();
  if (fields.size() != count)
    lines.fail(std::to_string(count) + " numbers are needed, found " + std::to_string(fields.size()),
               "the header of the scan is damaged; export the file again");
  Eigen::RowVector4d numbers = Eigen::RowVector4d::Zero();
  for (std::size_t i = 0; i < count; ++i) numbers[static_cast<Eigen::Index>(i)] = lines.number(fields[i]);
  return numbers;
}

/// PTX multiplies rows: site = point * matrix, so its last row is the translation.
std::optional<Pose> pose_of(LineReader& lines) {
  Eigen::Matrix4d rows;
  for (Eigen::Index i = 0; i < 4; ++i) rows.row(i) = header_numbers(lines, 4);
  const Eigen::Matrix4d matrix = rows.transpose();
  const Eigen::Matrix3d turn = matrix.topLeftCorner<3, 3>();
  const bool rigid = (turn.transpose() * turn - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 2.0 * rigid_to &&
                     turn.determinant() > 0.0 &&
                     (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() < rigid_to;
  if (!rigid)
    lines.fail("the transform above is not rigid (it scales, shears or mirrors)",
               "export the scan with a rotation and a translation only");
  if (matrix.isIdentity(0.0)) return std::nullopt;
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::Quaterniond(turn).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

Attributes attributes_of(const LineReader& lines, std::size_t values) {
  if (values != 3 && values != 4 && values != 7)
    lines.fail("a point of " + std::to_string(values) + " values", "write x y z intensity, then red green blue");
  return {values >= 4, values == 7, false};
}

void take(const LineReader& lines, const std::vector<Field>& fields, FilePoint& point) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.position[static_cast<Eigen::Index>(axis)] = lines.number_or_nan(fields[axis]);
  if (fields.size() >= 4) point.intensity = static_cast<float>(lines.number_or_nan(fields[3], "the intensity"));
  if (fields.size() == 7)
    for (std::size_t c = 0; c < 3; ++c) point.colour[c] = lines.byte(fields[4 + c]);
}

/// The `count` lines of a grid.
ScanData read_grid(LineReader& lines, std::uint64_t count, const std::string& name, const ReadOptions& options,
                   const Progress& progress) {
  const std::string where = lines.place();
  std::size_t values = 0;
  CloudBuilder builder({}, options);
  FilePoint point;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    if (!lines.next_with_text())
      lines.fail("the header says " + std::to_string(count) + " points, the file ends after " + std::to_string(i),
                 "the file is cut short; copy or export it again");
    const std::vector<Field>& fields = lines.fields_between_blanks();
    if (i == 0) {
      values = fields.size();
      builder = CloudBuilder(attributes_of(lines, values), options);
      builder.expect(count);
    }
    if (fields.size() != values)
      lines.fail("the line has " + std::to_string(fields.size()) + " values, the first one " + std::to_string(values),
                 "export the file again");
    take(lines, fields, point);
    if (point.position.isZero(0.0))
      builder.add_no_return();
    else
      builder.add(point, [&] { return lines.place(); });
  }
  return builder.finished(name, where, progress);
}

/// One scan, its number of columns on the present line.
ScanData read_scan(LineReader& lines, const std::string& name, const ReadOptions& options, const Progress& progress) {
  const std::uint64_t columns = side(lines, "columns");
  next_header_line(lines);
  const std::uint64_t count = columns * side(lines, "rows");
  for (int i = 0; i < 4; ++i) header_numbers(lines, 3);  // position and axes, said again by the matrix
  const std::optional<Pose> pose = pose_of(lines);
  lines.file().expect_records(lines.position(), count, least_line_bytes, "points");
  ScanData scan = read_grid(lines, count, name, options, progress);
  scan.file_pose = pose;
  return scan;
}

}  // namespace

std::vector<ScanData> read_ptx(const std::filesystem::path& path, const ReadOptions& options, Progress& progress) {
  LineReader lines(path);
  std::vector<ScanData> scans;
  while (lines.next_with_text())
    scans.push_back(read_scan(lines, path.stem().string() + "-" + std::to_string(scans.size() + 1), options, progress));
  if (scans.empty()) lines.fail("the file holds no points", "export the scan again with its points");
  if (scans.size() == 1) scans[0].name = path.stem().string();
  return scans;
}

}  // namespace adit::io
