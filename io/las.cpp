#include "io/las.h"

#include "io/bytes.h"
#include "io/las_description.h"
#include "io/las_header.h"
#include "io/point_stream.h"
#include "io/scan_sample.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;

Eigen::Vector3d position_in(const LasHeader& header, const std::byte* record) {
  const Eigen::Array3d steps(little<std::int32_t>(record), little<std::int32_t>(record + 4),
                             little<std::int32_t>(record + 8));
  return steps * header.scale.array() + header.offset.array();
}

/// Colours should fill 16 bits, but many files hold plain bytes: then no value is over 255.
bool colours_fill_16_bits(const InputFile& file, const LasHeader& header, const Progress& progress) {
  const std::uint16_t offset = *las_point_format(header.point_format).colour_offset;
  ByteCursor cursor(file, header.points_offset, file.size());
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.check();
    const std::byte* record = cursor.take(header.record_bytes);
    for (std::size_t c = 0; c < 3; ++c)
      if (little<std::uint16_t>(record + offset + 2 * c) > 255) return true;
  }
  return false;
}

}  // namespace

Attributes las_attributes(const LasHeader& header) {
  Attributes attributes;
  attributes.intensity = true;
  attributes.colour = las_point_format(header.point_format).colour_offset.has_value();
  return attributes;
}

bool is_las(std::string_view beginning) {
  return beginning.starts_with("LASF");
}

void stream_las(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  const InputFile file(path);
  const LasHeader header = read_las_header(file);
  const Attributes attributes = las_attributes(header);
  const std::uint16_t colour_offset = las_point_format(header.point_format).colour_offset.value_or(0);
  PointStream out(
      {path.stem().string(), file.name(), attributes, std::nullopt, header.points, header.box, las_unit(file, header)},
      options, NanMeans::invalid, sink);
  if (!out.wanted()) return;
  const int shift = attributes.colour && colours_fill_16_bits(file, header, progress) ? 8 : 0;
  ByteCursor cursor(file, header.points_offset, file.size());
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(i, header.points);
    const std::byte* record = cursor.take(header.record_bytes);
    point.position = position_in(header, record);
    point.intensity = static_cast<float>(little<std::uint16_t>(record + las_intensity_offset));
    if (attributes.colour)
      for (std::size_t c = 0; c < 3; ++c)
        point.colour[c] = static_cast<std::uint8_t>(little<std::uint16_t>(record + colour_offset + 2 * c) >> shift);
    out.add(point, [&] { return file.name() + ": point " + std::to_string(i + 1); });
  }
  out.end();
}

ScanFileSummary las_summary(const InputFile& file, const LasHeader& header, const std::string& format) {
  ScanFileSummary summary;
  summary.format =
      format + " 1." + std::to_string(header.minor_version) + " point format " + std::to_string(header.point_format);
  summary.header = las_description(file, header);
  ScanSummary scan;
  scan.name = file.path().stem().string();
  scan.points = header.points;
  scan.box = header.box;
  if (!scan.box.isEmpty()) scan.box_from = "header";
  scan.attributes = attribute_names(las_attributes(header));
  summary.scans.push_back(std::move(scan));
  return summary;
}

ScanFileSummary summarise_las(const std::filesystem::path& path, Progress&) {
  const InputFile file(path);
  const LasHeader header = read_las_header(file);
  ScanFileSummary summary = las_summary(file, header, "LAS");
  take_sample(summary.scans.front(),
              sample_records(file, header.points_offset, header.record_bytes, header.points,
                             [&](const std::byte* record) { return position_in(header, record); }));
  return summary;
}

}  // namespace adit::io
