#include "io/xyz.h"

#include "io/atomic_file.h"
#include "io/outgoing_scan.h"
#include "io/point_stream.h"
#include "io/text_line.h"
#include "io/xyz_columns.h"

namespace adit::io {
namespace {

constexpr std::uint64_t lines_between_checks = 8192;
constexpr int decimals = 5;  // a hundredth of a millimetre

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

void write_xyz(const std::filesystem::path& path, const ScanData& scan_data, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {}, path);
  const OutgoingScan scan(scan_data, PoseGoes::into_points, path);
  const PointCloud& cloud = scan.cloud();
  TextLine line(path.extension() == ".csv" ? ',' : ' ');
  line.add("x").add("y").add("z");
  if (cloud.has_intensity()) line.add("intensity");
  if (cloud.has_colour()) line.add("r").add("g").add("b");
  if (cloud.has_normals()) line.add("nx").add("ny").add("nz");
  AtomicFile file(path);
  file.append(line.ended());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % lines_between_checks == 0) progress.step(i, scan.size());
    line.clear();
    if (scan.is_float32())
      for (const float c : cloud.points[i]) line.add(c);
    else
      for (const double c : scan.position(i)) line.add(c, decimals);
    if (cloud.has_intensity()) line.add(cloud.intensity[i]);
    if (cloud.has_colour())
      for (const std::uint8_t c : cloud.colour[i]) line.add(unsigned{c});
    if (cloud.has_normals())
      for (const float c : scan.normal(i)) line.add(c);
    file.append(line.ended());
  }
  file.commit();
}

}  // namespace adit::io
