#include "io/pcd.h"

#include <bit>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/pcd_header.h"
#include "io/pcd_pcl.h"
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

void read_records(const InputFile& file, const PcdHeader& header, CloudBuilder& builder, const Progress& progress) {
  const std::vector<std::uint8_t> records = pcd_records(file, header);
  std::vector<PcdField> wanted = header.fields;
  std::erase_if(wanted, [](const PcdField& field) { return field.target == PcdTarget::none; });
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(i, header.points);
    const auto* record = reinterpret_cast<const std::byte*>(records.data() + i * header.point_bytes);
    for (const PcdField& field : wanted) {
      if (field.target == PcdTarget::packed_colour)
        put_colour(point, little<std::uint32_t>(record + field.offset));
      else
        put(point, field.target, stored_value(field, record + field.offset));
    }
    builder.add(point, [&] { return file.name() + ": point " + std::to_string(i + 1); });
  }
}

/// In a text file a packed colour is the whole number, or the float that has the same bits.
void put_text_colour(FilePoint& point, const PcdField& field, double value) {
  if (field.type == 'F')
    put_colour(point, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  else if (value >= -2147483648.0 && value <= 4294967295.0)
    put_colour(point, static_cast<std::uint32_t>(static_cast<std::int64_t>(value)));
}

void read_text(const InputFile& file, const PcdHeader& header, CloudBuilder& builder, const Progress& progress) {
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
      const double value = field.target == PcdTarget::none ? 0.0 : lines.number_or_nan(words[next]);
      if (field.target == PcdTarget::packed_colour)
        put_text_colour(point, field, value);
      else
        put(point, field.target, value);
      next += field.count;
    }
    builder.add(point, [&] { return lines.place(); });
  }
  if (lines.next_with_text())
    lines.fail("there are more points than the header says", "the header is damaged; export the file again");
}

}  // namespace

bool is_pcd(std::string_view beginning) {
  return beginning.starts_with("# .PCD") || beginning.starts_with("VERSION 0.7\n") ||
         beginning.starts_with("VERSION .7\n");
}

ScanData read_pcd(const std::filesystem::path& path, const ReadOptions& options, Progress& progress) {
  const InputFile file(path);
  const PcdHeader header = read_pcd_header(file);
  const bool organised = header.height > 1;
  CloudBuilder builder(pcd_attributes(header), options, organised ? NanMeans::no_return : NanMeans::no_return_if_all);
  builder.expect(header.points);
  if (header.encoding == PcdEncoding::ascii)
    read_text(file, header, builder, progress);
  else
    read_records(file, header, builder, progress);
  ScanData scan = builder.finished(path.stem().string(), file.name(), progress);
  scan.file_pose = header.viewpoint;
  return scan;
}

ScanFileSummary summarise_pcd(const std::filesystem::path& path) {
  const InputFile file(path);
  const PcdHeader header = read_pcd_header(file);
  ScanFileSummary summary;
  summary.format = header.encoding == PcdEncoding::ascii    ? "PCD ascii"
                   : header.encoding == PcdEncoding::binary ? "PCD binary"
                                                            : "PCD binary compressed";
  ScanSummary scan;
  scan.name = path.stem().string();
  scan.points = header.points;
  scan.pose = header.viewpoint;
  scan.attributes = attribute_names(pcd_attributes(header));
  summary.scans.push_back(scan);
  return summary;
}

}  // namespace adit::io
