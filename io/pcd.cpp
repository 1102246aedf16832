#include "io/pcd.h"

#include <algorithm>
#include <bit>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/lzf_stream.h"
#include "io/pcd_header.h"
#include "io/point_stream.h"
#include "io/scan_sample.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;

double stored_value(const PcdField& field, const std::byte* from) {
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? static_cast<double>(little<std::int8_t>(from))
                       : static_cast<double>(little<std::uint8_t>(from));
    case 2:
      return is_signed ? static_cast<double>(little<std::int16_t>(from))
                       : static_cast<double>(little<std::uint16_t>(from));
    case 4:
      if (field.type == 'F') return static_cast<double>(little<float>(from));
      return is_signed ? static_cast<double>(little<std::int32_t>(from))
                       : static_cast<double>(little<std::uint32_t>(from));
    default:
      if (field.type == 'F') return little<double>(from);
      return is_signed ? static_cast<double>(little<std::int64_t>(from))
                       : static_cast<double>(little<std::uint64_t>(from));
  }
}

void put_colour(FilePoint& point, std::uint32_t packed) {
  point.colour = {static_cast<std::uint8_t>(packed >> 16 & 0xFF), static_cast<std::uint8_t>(packed >> 8 & 0xFF),
                  static_cast<std::uint8_t>(packed & 0xFF)};
}

void put(FilePoint& point, PcdTarget target, double value) {
  switch (target) {
    case PcdTarget::x:
    case PcdTarget::y:
    case PcdTarget::z:
      point.position[static_cast<int>(target) - static_cast<int>(PcdTarget::x)] = value;
      break;
    case PcdTarget::intensity:
      point.intensity = static_cast<float>(value);
      break;
    case PcdTarget::nx:
    case PcdTarget::ny:
    case PcdTarget::nz:
      point.normal[static_cast<int>(target) - static_cast<int>(PcdTarget::nx)] = static_cast<float>(value);
      break;
    case PcdTarget::packed_colour:
    case PcdTarget::none:
      break;
  }
}

void put_field(FilePoint& point, const PcdField& field, const std::byte* from) {
  if (field.target == PcdTarget::packed_colour)
    put_colour(point, little<std::uint32_t>(from));
  else
    put(point, field.target, stored_value(field, from));
}

std::vector<PcdField> wanted_fields(const PcdHeader& header) {
  std::vector<PcdField> wanted = header.fields;
  std::erase_if(wanted, [](const PcdField& field) { return field.target == PcdTarget::none; });
  return wanted;
}

void read_records(const InputFile& file, const PcdHeader& header, PointStream& out, const Progress& progress) {
  const std::vector<PcdField> wanted = wanted_fields(header);
  ByteCursor cursor(file, header.body_offset, file.size());
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(i, header.points);
    const std::byte* record = cursor.take(static_cast<std::size_t>(header.point_bytes));
    for (const PcdField& field : wanted) put_field(point, field, record + field.offset);
    out.add(point, [&] { return file.name() + ": point " + std::to_string(i + 1); });
  }
}

LzfStream pcd_body(const InputFile& file, const PcdHeader& header) {
  const auto packed = file.read(header.body_offset, 4, "the sizes of the compressed points");
  return {file, header.body_offset + 8, header.body_offset + 8 + little<std::uint32_t>(packed.data())};
}

/// A compressed body holds all x, then all y, and so on: every wanted field is unpacked by a stream of its own.
void read_columns(const InputFile& file, const PcdHeader& header, PointStream& out, const Progress& progress) {
  for (const PcdField& field : header.fields)
    if (field.name == "_") throw Error("a compressed file with padding fields (_)", file.name(), "export it as binary");
  const std::vector<PcdField> wanted = wanted_fields(header);
  std::vector<LzfStream> streams;
  for (const PcdField& field : wanted) {
    streams.push_back(pcd_body(file, header));
    streams.back().skip(field.offset * header.points, progress);
  }
  std::vector<std::byte> values;
  std::vector<FilePoint> points;
  for (std::uint64_t done = 0; done < header.points; done += points.size()) {
    progress.step(done, header.points);
    points.assign(static_cast<std::size_t>(std::min(points_between_checks, header.points - done)), FilePoint());
    for (std::size_t f = 0; f < wanted.size(); ++f) {
      const auto width = static_cast<std::size_t>(wanted[f].size * wanted[f].count);
      values.resize(width * points.size());
      streams[f].read(values);
      for (std::size_t i = 0; i < points.size(); ++i) put_field(points[i], wanted[f], values.data() + i * width);
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      out.add(points[i], [&] { return file.name() + ": point " + std::to_string(done + i + 1); });
  }
}

/// In a text file a packed colour is the whole number, or the float that has the same bits.
void put_text_colour(FilePoint& point, const PcdField& field, double value) {
  if (field.type == 'F')
    put_colour(point, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  else if (value >= -2147483648.0 && value <= 4294967295.0)
    put_colour(point, static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
}

/// The header says what the number was before it became text: the same point comes out of all encodings.
double as_declared(double value, const PcdField& field) {
  return field.type == 'F' && field.size == 4 ? static_cast<double>(static_cast<float>(value)) : value;
}

void read_text(const InputFile& file, const PcdHeader& header, PointStream& out, const Progress& progress) {
  LineReader lines(file, header.body_offset, header.body_line);
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), file.size());
    if (!lines.next_with_text())
      lines.fail(
          "the header says " + std::to_string(header.points) + " points, the file ends after " + std::to_string(i),
          "the file is cut short; copy or export it again");
    const std::vector<Field>& words = lines.fields_between_blanks();
    if (words.size() != header.values)
      lines.fail(
          "the line has " + std::to_string(words.size()) + " values, the header says " + std::to_string(header.values),
          "export the file again");
    std::size_t next = 0;
    for (const PcdField& field : header.fields) {
      const double value = field.target == PcdTarget::none ? 0.0 : as_declared(lines.number_or_nan(words[next]), field);
      if (field.target == PcdTarget::packed_colour)
        put_text_colour(point, field, value);
      else
        put(point, field.target, value);
      next += field.count;
    }
    out.add(point, [&] { return lines.place(); });
  }
  if (lines.next_with_text())
    lines.fail("there are more points than the header says", "the header is damaged; export the file again");
}

/// Nothing of a compressed file: its coordinates stand far apart, and no byte of them is found without all before it.
ScanSample sampled(const InputFile& file, const PcdHeader& header) {
  if (header.encoding == PcdEncoding::compressed) return {};
  if (header.encoding == PcdEncoding::ascii) {
    TextColumns text;
    std::size_t column = 0;
    for (const PcdField& field : header.fields) {
      if (field.target >= PcdTarget::x && field.target <= PcdTarget::z)
        text.xyz[static_cast<std::size_t>(field.target) - static_cast<std::size_t>(PcdTarget::x)] = column;
      column += static_cast<std::size_t>(field.count);
    }
    return sample_lines(file, header.body_offset, file.size(), text, header.points);
  }
  const std::vector<PcdField> wanted = wanted_fields(header);
  return sample_records(file, header.body_offset, header.point_bytes, header.points, [&](const std::byte* record) {
    FilePoint point;
    for (const PcdField& field : wanted) put_field(point, field, record + field.offset);
    return point.position;
  });
}

}  // namespace

bool is_pcd(std::string_view beginning) {
  return beginning.starts_with("# .PCD") || beginning.starts_with("VERSION 0.7\n") ||
         beginning.starts_with("VERSION .7\n");
}

void stream_pcd(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  const InputFile file(path);
  const PcdHeader header = read_pcd_header(file);
  const bool organised = header.height > 1;
  PointStream out({path.stem().string(), file.name(), pcd_attributes(header), header.viewpoint, header.points, {}},
                  options, organised ? NanMeans::no_return : NanMeans::no_return_if_all, sink);
  if (!out.wanted()) return;
  if (header.encoding == PcdEncoding::ascii)
    read_text(file, header, out, progress);
  else if (header.encoding == PcdEncoding::binary)
    read_records(file, header, out, progress);
  else
    read_columns(file, header, out, progress);
  out.end();
}

ScanFileSummary summarise_pcd(const std::filesystem::path& path, Progress&) {
  const InputFile file(path);
  const PcdHeader header = read_pcd_header(file);
  ScanFileSummary summary;
  summary.format = header.encoding == PcdEncoding::ascii    ? "PCD ascii"
                   : header.encoding == PcdEncoding::binary ? "PCD binary"
                                                            : "PCD binary compressed";
  std::string fields;
  for (const PcdField& field : header.fields) fields += (fields.empty() ? "" : " ") + field.name;
  summary.header.push_back({"fields", fields});
  ScanSummary scan;
  scan.name = path.stem().string();
  scan.points = header.points;
  scan.pose = header.viewpoint;
  scan.attributes = attribute_names(pcd_attributes(header));
  if (header.height > 1) {
    scan.columns = header.width;
    scan.rows = header.height;
  }
  take_sample(scan, sampled(file, header));
  summary.scans.push_back(std::move(scan));
  return summary;
}

}  // namespace adit::io
