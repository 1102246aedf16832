#include "io/xyz.h"

#include "io/point_stream.h"
#include "io/scan_sample.h"
#include "io/xyz_columns.h"

namespace adit::io {
namespace {

constexpr std::uint64_t lines_between_checks = 8192;
constexpr std::uint64_t most_counted_bytes = std::uint64_t{64} << 20;

bool is_comment(std::string_view line) {
  const auto begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return false;
  return line[begin] == '#' || line.substr(begin).starts_with("//");
}

/// Column names that a comment before the points may hold ("# x y z", "//X,Y,Z").
std::optional<XyzColumns> columns_in_comment(const LineReader& lines) {
  const std::string_view text =
      lines.line().substr(std::min(lines.line().find_first_not_of(" \t#/"), lines.line().size()));
  std::vector<Field> names;
  const char separator = separator_of(text);
  if (separator == blanks)
    split_at_blanks(text, lines.line_number(), names);
  else
    split_at(separator, text, lines.line_number(), names);
  return named_columns(lines, names);
}

/// Goes to the next line that is neither blank nor a comment.
bool next_point_line(LineReader& lines) {
  while (lines.next_with_text())
    if (!is_comment(lines.line())) return true;
  return false;
}

struct Layout {
  XyzColumns columns;
  char separator = blanks;
};

/// Reads up to the first point, which is then the present line.
Layout sniffed_layout(LineReader& lines) {
  std::optional<XyzColumns> named;
  bool found = false;
  while (!found && lines.next_with_text()) {
    if (!is_comment(lines.line()))
      found = true;
    else if (const auto columns = columns_in_comment(lines))
      named = columns;
  }
  Layout layout;
  layout.separator = separator_of(lines.line());
  std::vector<Field> fields = columns_of_line(lines, layout.separator);
  const bool has_names = found && !begins_with_number(fields);
  if (has_names) {
    named = named_columns(lines, fields);
    if (!named) lines.fail("a point or the column names x, y and z are needed", "name the columns in the first line");
    found = next_point_line(lines);
    layout.separator = separator_of(lines.line());  // some programs part names by commas and numbers by blanks
    fields = columns_of_line(lines, layout.separator);
  }
  if (!found) lines.fail("the file holds no points", "export the scan again with its points");
  // Names in a comment hold only where they fit the columns; a comment may be prose.
  if (named && (has_names || named->count == fields.size()))
    layout.columns = *named;
  else
    layout.columns = first_three_columns(fields.size());
  if (layout.columns.count < 3)
    lines.fail("a point needs x, y and z", "name a file that begins with the number of points .pts");
  return layout;
}

void take(const LineReader& lines, const std::vector<Field>& fields, const XyzColumns& columns, FilePoint& point) {
  const auto field = [&](XyzTarget target) -> const Field& { return fields[*columns[target]]; };
  point.position = {lines.number_or_nan(field(XyzTarget::x)), lines.number_or_nan(field(XyzTarget::y)),
                    lines.number_or_nan(field(XyzTarget::z))};
  const Attributes attributes = columns.attributes();
  if (attributes.intensity)
    point.intensity = static_cast<float>(lines.number_or_nan(field(XyzTarget::intensity), "the intensity"));
  if (attributes.colour)
    point.colour = {lines.byte(field(XyzTarget::red)), lines.byte(field(XyzTarget::green)),
                    lines.byte(field(XyzTarget::blue))};
  if (attributes.normals)
    point.normal = Eigen::Vector3d(lines.number_or_nan(field(XyzTarget::nx)), lines.number_or_nan(field(XyzTarget::ny)),
                                   lines.number_or_nan(field(XyzTarget::nz)))
                       .cast<float>();
}

void expect_columns(const LineReader& lines, std::size_t found, std::size_t wanted) {
  if (found != wanted)
    lines.fail("the line has " + std::to_string(found) + " columns, " + std::to_string(wanted) + " are expected",
               "give every line the same columns, and numbers a decimal point");
}

/// From the present line to the last.
std::uint64_t counted_points(LineReader& lines, const Progress& progress) {
  std::uint64_t points = 0;
  do {
    if (points++ % lines_between_checks == 0) progress.step(lines.position(), lines.file().size());
  } while (next_point_line(lines));
  return points;
}

}  // namespace

void stream_xyz(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  LineReader lines(path);
  const Layout layout = sniffed_layout(lines);
  PointStream out({path.stem().string(), lines.file().name(), layout.columns.attributes(), std::nullopt, 0, {}},
                  options, NanMeans::invalid, sink);
  if (!out.wanted()) return;
  FilePoint point;
  std::uint64_t i = 0;
  do {
    if (i++ % lines_between_checks == 0) progress.step(lines.position(), lines.file().size());
    const std::vector<Field>& fields =
        layout.separator == blanks ? lines.fields_between_blanks() : lines.fields(layout.separator);
    std::size_t count = fields.size();
    while (count > 0 && fields[count - 1].text.empty()) --count;
    expect_columns(lines, count, layout.columns.count);
    take(lines, fields, layout.columns, point);
    out.add(point, [&] { return lines.place(); });
  } while (next_point_line(lines));
  out.end();
}

ScanFileSummary summarise_xyz(const std::filesystem::path& path, Progress& progress) {
  LineReader lines(path);
  const Layout layout = sniffed_layout(lines);
  const std::uint64_t begin = lines.position() - lines.line().size();  // of the first point, but for its line's end
  ScanFileSummary summary;
  summary.format = "XYZ text";
  summary.header.push_back({"columns", std::to_string(layout.columns.count)});
  ScanSummary scan;
  scan.name = path.stem().string();
  scan.attributes = attribute_names(layout.columns.attributes());
  const std::uint64_t bytes = lines.file().size();
  scan.points_estimated = bytes > most_counted_bytes;
  if (!scan.points_estimated) scan.points = counted_points(lines, progress);
  TextColumns columns{layout.separator, {}, false};
  for (std::size_t axis = 0; axis < 3; ++axis) columns.xyz[axis] = *layout.columns[static_cast<XyzTarget>(axis)];
  const ScanSample sample = sample_lines(lines.file(), begin, bytes, columns, scan.points);
  if (scan.points_estimated && sample.bytes_per_point > 0.0)
    scan.points = static_cast<std::uint64_t>(static_cast<double>(bytes - begin) / sample.bytes_per_point);
  take_sample(scan, sample);
  summary.scans.push_back(std::move(scan));
  return summary;
}

}  // namespace adit::io
