#include "io/ptx.h"

#include <cmath>

#include "core/foundation/error.h"
#include "io/point_stream.h"
#include "io/scan_sample.h"
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
  return {values >= 4, values == 7, false, true};
}

void take(const LineReader& lines, const std::vector<Field>& fields, FilePoint& point) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    point.position[static_cast<Eigen::Index>(axis)] = lines.number_or_nan(fields[axis]);
  if (fields.size() >= 4) point.intensity = static_cast<float>(lines.number_or_nan(fields[3], "the intensity"));
  if (fields.size() == 7)
    for (std::size_t c = 0; c < 3; ++c) point.colour[c] = lines.byte(fields[4 + c]);
}

struct Grid {
  std::uint64_t columns = 0;
  std::uint64_t rows = 0;
  std::uint64_t places() const { return columns * rows; }
};

[[noreturn]] void ended_early(const LineReader& lines, std::uint64_t done, const Grid& grid) {
  lines.fail(
      "the header says " + std::to_string(grid.places()) + " points, the file ends after " + std::to_string(done),
      "the file is cut short; copy or export it again");
}

const std::vector<Field>& next_place(LineReader& lines, std::uint64_t done, const Grid& grid) {
  if (!lines.next_with_text()) ended_early(lines, done, grid);
  return lines.fields_between_blanks();
}

/// The lines of a grid, column by column.
void stream_grid(LineReader& lines, const Grid& grid, ScanHeader header, const ReadOptions& options, ScanSink& sink,
                 const Progress& progress) {
  const std::size_t values = next_place(lines, 0, grid).size();
  header.attributes = attributes_of(lines, values);
  PointStream out(std::move(header), options, NanMeans::invalid, sink);
  FilePoint point;
  for (std::uint64_t i = 0; i < grid.places(); ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    const std::vector<Field>& fields = i == 0 ? lines.fields_between_blanks() : next_place(lines, i, grid);
    if (fields.size() != values)
      lines.fail("the line has " + std::to_string(fields.size()) + " values, the first one " + std::to_string(values),
                 "export the file again");
    if (!out.wanted()) continue;
    take(lines, fields, point);
    point.grid = {static_cast<std::uint32_t>(i % grid.rows), static_cast<std::uint32_t>(i / grid.rows)};
    if (point.position.isZero(0.0))
      out.add_no_return();
    else
      out.add(point, [&] { return lines.place(); });
  }
  out.end();
}

/// The header of a scan, its number of columns on the present line.
ScanHeader scan_header(LineReader& lines, const std::string& name, Grid& grid) {
  grid.columns = side(lines, "columns");
  next_header_line(lines);
  grid.rows = side(lines, "rows");
  for (int i = 0; i < 4; ++i) header_numbers(lines, 3);  // position and axes, said again by the matrix
  ScanHeader header;
  header.name = name;
  header.file_pose = pose_of(lines);
  header.where = lines.place();
  header.points = grid.places();
  lines.file().expect_records(lines.position(), grid.places(), least_line_bytes, "points");
  if (grid.places() == 0)
    throw Error("the scan holds no points", header.where, "export the scan again with its points");
  return header;
}

void stream_scan(LineReader& lines, const std::string& name, const ReadOptions& options, ScanSink& sink,
                 const Progress& progress) {
  Grid grid;
  ScanHeader header = scan_header(lines, name, grid);
  stream_grid(lines, grid, std::move(header), options, sink, progress);
}

/// The same without reading the points.
ScanSummary summary_of_scan(LineReader& lines, const std::string& name, const Progress& progress) {
  Grid grid;
  const ScanHeader header = scan_header(lines, name, grid);
  const std::uint64_t begin = lines.position();
  ScanSummary scan;
  scan.name = name;
  scan.pose = header.file_pose;
  scan.points = grid.places();
  scan.columns = grid.columns;
  scan.rows = grid.rows;
  scan.attributes = attribute_names(attributes_of(lines, next_place(lines, 0, grid).size()));
  for (std::uint64_t i = 1; i < grid.places(); ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    if (!lines.next_with_text()) ended_early(lines, i, grid);
  }
  TextColumns columns;
  columns.zero_is_no_return = true;
  take_sample(scan, sample_lines(lines.file(), begin, lines.position(), columns, grid.places()));
  return scan;
}

/// Goes to the next scan; false at the end of the file.
bool next_scan(LineReader& lines, int scans) {
  if (lines.next_with_text()) return true;
  if (scans == 0) lines.fail("the file holds no points", "export the scan again with its points");
  return false;
}

}  // namespace

void stream_ptx(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  LineReader lines(path);
  for (int scans = 0; next_scan(lines, scans); ++scans)
    stream_scan(lines, name_of_scan(path, scans + 1), options, sink, progress);
}

ScanFileSummary summarise_ptx(const std::filesystem::path& path, Progress& progress) {
  LineReader lines(path);
  ScanFileSummary summary;
  summary.format = "PTX";
  for (int scans = 0; next_scan(lines, scans); ++scans)
    summary.scans.push_back(summary_of_scan(lines, name_of_scan(path, scans + 1), progress));
  return summary;
}

}  // namespace adit::io
