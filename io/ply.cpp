#include "io/ply.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/ply_header.h"
#include "io/point_stream.h"
#include "io/scan_sample.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;

/// Colours are bytes, 16-bit numbers or fractions of one, as the type says.
std::uint8_t colour_byte(double value, PlyType type) {
  if (!std::isfinite(value)) return 0;
  double byte = value;
  if (type == PlyType::int8 && value < 0.0) byte = value + 256.0;
  if (type == PlyType::uint16 || type == PlyType::int16) byte = std::floor(value / 256.0);
  if (type == PlyType::float32 || type == PlyType::float64) byte = std::round(value * 255.0);
  return static_cast<std::uint8_t>(std::clamp(byte, 0.0, 255.0));
}

inline void put(FilePoint& point, PlyTarget target, PlyType type, double value) {
  switch (target) {
    case PlyTarget::x:
    case PlyTarget::y:
    case PlyTarget::z:
      point.position[static_cast<int>(target) - static_cast<int>(PlyTarget::x)] = value;
      break;
    case PlyTarget::intensity:
      point.intensity = static_cast<float>(value);
      break;
    case PlyTarget::red:
    case PlyTarget::green:
    case PlyTarget::blue:
      point.colour[static_cast<std::size_t>(target) - static_cast<std::size_t>(PlyTarget::red)] =
          colour_byte(value, type);
      break;
    case PlyTarget::nx:
    case PlyTarget::ny:
    case PlyTarget::nz:
      point.normal[static_cast<int>(target) - static_cast<int>(PlyTarget::nx)] = static_cast<float>(value);
      break;
    case PlyTarget::none:
      break;
  }
}

/// One property of a vertex and what it is to us.
struct Column {
  PlyTarget target;
  PlyType type;
  std::optional<PlyType> list_count;
  std::size_t offset;  ///< in a row without lists
};

std::vector<Column> columns_of(const PlyElement& vertex) {
  std::vector<Column> columns;
  std::size_t offset = 0;
  for (const PlyProperty& property : vertex.properties) {
    const PlyTarget target = property.list_count ? PlyTarget::none : ply_target(property.name);
    columns.push_back({target, property.type, property.list_count, offset});
    offset += size_of(property.type);
  }
  return columns;
}

std::uint64_t checked_length(const InputFile& file, std::uint64_t offset, double length) {
  if (length >= 0.0 && length == std::floor(length) && length <= 4294967295.0)
    return static_cast<std::uint64_t>(length);
  throw Error("a list cannot have this length", file.at_byte(offset), "the file is damaged; export it again");
}

void skip_binary_row(const InputFile& file, const PlyHeader& header, const PlyElement& element, ByteCursor& cursor) {
  for (const PlyProperty& property : element.properties) {
    if (!property.list_count) {
      cursor.skip(size_of(property.type));
      continue;
    }
    const std::uint64_t at = cursor.position();
    const double length = ply_value(*property.list_count, header.order, cursor.take(size_of(*property.list_count)));
    cursor.skip(checked_length(file, at, length) * size_of(property.type));
  }
}

/// Passes over the elements that stand before the vertices.
void skip_to_vertices(const InputFile& file, const PlyHeader& header, ByteCursor& cursor, const Progress& progress) {
  for (std::size_t e = 0; e < header.vertex; ++e) {
    const PlyElement& element = header.elements[e];
    if (!element.has_lists()) {
      cursor.skip(element.count * element.row_bytes());
      continue;
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      if (row % points_between_checks == 0) progress.check();
      skip_binary_row(file, header, element, cursor);
    }
  }
}

void read_row_with_lists(const InputFile& file, std::endian order, const std::vector<Column>& columns,
                         ByteCursor& cursor, FilePoint& point) {
  for (const Column& column : columns) {
    const std::uint64_t at = cursor.position();
    if (column.list_count) {
      const double length = ply_value(*column.list_count, order, cursor.take(size_of(*column.list_count)));
      cursor.skip(checked_length(file, at, length) * size_of(column.type));
    } else {
      put(point, column.target, column.type, ply_value(column.type, order, cursor.take(size_of(column.type))));
    }
  }
}

/// Rows with lists have no fixed length: value by value.
void read_rows_with_lists(const InputFile& file, const PlyHeader& header, ByteCursor& cursor, PointStream& out,
                          const Progress& progress) {
  const PlyElement& vertex = header.elements[header.vertex];
  const std::vector<Column> columns = columns_of(vertex);
  FilePoint point;
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    if (i % points_between_checks == 0) progress.step(i, vertex.count);
    const std::uint64_t at = cursor.position();
    read_row_with_lists(file, header.order, columns, cursor, point);
    out.add(point, [&] { return file.at_byte(at) + " (point " + std::to_string(i + 1) + ")"; });
  }
}

/// Column by column: the type is looked at once for many rows.
void read_rows(const InputFile& file, const PlyHeader& header, ByteCursor& cursor, PointStream& out,
               const Progress& progress) {
  const PlyElement& vertex = header.elements[header.vertex];
  std::vector<Column> columns = columns_of(vertex);
  std::erase_if(columns, [](const Column& column) { return column.target == PlyTarget::none; });
  const auto row_bytes = static_cast<std::size_t>(vertex.row_bytes());
  const std::uint64_t most_rows = std::max<std::uint64_t>(1, (std::uint64_t{1} << 16) / row_bytes);
  std::vector<FilePoint> points;
  std::vector<double> values;
  for (std::uint64_t done = 0; done < vertex.count; done += points.size()) {
    progress.step(done, vertex.count);
    const std::uint64_t at = cursor.position();
    points.assign(static_cast<std::size_t>(std::min(most_rows, vertex.count - done)), FilePoint());
    values.resize(points.size());
    const std::byte* rows = cursor.take(points.size() * row_bytes);
    for (const Column& column : columns) {
      ply_values(column.type, header.order, rows + column.offset, row_bytes, points.size(), values.data());
      for (std::size_t i = 0; i < points.size(); ++i) put(points[i], column.target, column.type, values[i]);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      out.add(points[i],
              [&] { return file.at_byte(at + i * row_bytes) + " (point " + std::to_string(done + i + 1) + ")"; });
  }
}

void read_binary(const InputFile& file, const PlyHeader& header, PointStream& out, const Progress& progress) {
  ByteCursor cursor(file, header.body_offset, file.size());
  skip_to_vertices(file, header, cursor, progress);
  if (header.elements[header.vertex].has_lists())
    read_rows_with_lists(file, header, cursor, out, progress);
  else
    read_rows(file, header, cursor, out, progress);
}

void next_row(LineReader& lines, const std::string& of) {
  if (!lines.next_with_text())
    throw Error("the file ends before the last of the " + of, lines.place(),
                "the file is cut short; copy or export it again");
}

/// The header says what the number was before it became text: the same point comes out of all encodings.
double as_declared(double value, PlyType type) {
  return type == PlyType::float32 ? static_cast<double>(static_cast<float>(value)) : value;
}

void read_text_row(LineReader& lines, const std::vector<Column>& columns, FilePoint& point) {
  const std::vector<Field>& fields = lines.fields_between_blanks();
  std::size_t next = 0;
  for (const Column& column : columns) {
    if (next >= fields.size()) lines.fail("the line holds fewer values than the header says", "export the file again");
    if (column.list_count) {
      const std::uint64_t length = lines.count(fields[next]);
      if (length > fields.size()) lines.fail(fields[next], "a list is longer than its line", "export the file again");
      next += 1 + static_cast<std::size_t>(length);
    } else {
      const Field& field = fields[next++];
      if (column.target != PlyTarget::none)
        put(point, column.target, column.type, as_declared(lines.number_or_nan(field), column.type));
    }
  }
  if (next != fields.size()) lines.fail("the line holds other values than the header says", "export the file again");
}

void read_text(const InputFile& file, const PlyHeader& header, PointStream& out, const Progress& progress) {
  LineReader lines(file, header.body_offset, header.body_line);
  for (const PlyElement& element : header.elements) {
    const bool is_vertex = &element == &header.elements[header.vertex];
    const std::vector<Column> columns = columns_of(element);
    FilePoint point;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (i % points_between_checks == 0) progress.step(lines.position(), file.size());
      next_row(lines, std::to_string(element.count) + " rows of " + element.name);
      if (!is_vertex) continue;
      read_text_row(lines, columns, point);
      out.add(point, [&] { return lines.place(); });
    }
  }
  if (lines.next_with_text())
    lines.fail("there are more rows than the header says", "the header is damaged; export the file again");
}

/// Nothing where only reading tells where the points stand: behind or among rows of any length.
ScanSample sampled(const InputFile& file, const PlyHeader& header) {
  const PlyElement& vertex = header.elements[header.vertex];
  if (vertex.has_lists()) return {};
  const std::vector<Column> columns = columns_of(vertex);
  if (header.ascii) {
    TextColumns text;
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (columns[i].target >= PlyTarget::x && columns[i].target <= PlyTarget::z)
        text.xyz[static_cast<std::size_t>(columns[i].target) - static_cast<std::size_t>(PlyTarget::x)] = i;
    for (const PlyElement& element : header.elements)
      if (&element != &vertex && element.count > 0) return {};
    return sample_lines(file, header.body_offset, file.size(), text, vertex.count);
  }
  std::uint64_t begin = header.body_offset;
  for (std::size_t e = 0; e < header.vertex; ++e) {
    if (header.elements[e].has_lists()) return {};
    begin += header.elements[e].count * header.elements[e].row_bytes();
  }
  return sample_records(file, begin, vertex.row_bytes(), vertex.count, [&](const std::byte* row) {
    FilePoint point;
    for (const Column& column : columns)
      put(point, column.target, column.type, ply_value(column.type, header.order, row + column.offset));
    return point.position;
  });
}

}  // namespace

bool is_ply(std::string_view beginning) {
  return beginning.starts_with("ply\n") || beginning.starts_with("ply\r") || beginning.starts_with("ply ");
}

void stream_ply(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  const InputFile file(path);
  const PlyHeader header = read_ply_header(file);
  const PlyElement& vertex = header.elements[header.vertex];
  PointStream out({path.stem().string(), file.name(), ply_attributes(vertex), std::nullopt, vertex.count, {}}, options,
                  NanMeans::invalid, sink);
  if (!out.wanted()) return;
  if (header.ascii)
    read_text(file, header, out, progress);
  else
    read_binary(file, header, out, progress);
  out.end();
}

ScanFileSummary summarise_ply(const std::filesystem::path& path, Progress&) {
  const InputFile file(path);
  const PlyHeader header = read_ply_header(file);
  const PlyElement& vertex = header.elements[header.vertex];
  ScanFileSummary summary;
  summary.format = header.ascii                       ? "PLY ascii"
                   : header.order == std::endian::big ? "PLY binary big endian"
                                                      : "PLY binary little endian";
  for (const std::string& comment : header.comments) summary.header.push_back({"comment", comment});
  for (const PlyElement& element : header.elements)
    if (&element != &vertex) summary.header.push_back({"also", std::to_string(element.count) + " of " + element.name});
  ScanSummary scan;
  scan.name = path.stem().string();
  scan.points = vertex.count;
  scan.attributes = attribute_names(ply_attributes(vertex));
  take_sample(scan, sampled(file, header));
  summary.scans.push_back(std::move(scan));
  return summary;
}

}  // namespace adit::io
