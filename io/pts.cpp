#include "io/pts.h"

#include "core/foundation/error.h"
#include "io/point_stream.h"
#include "io/scan_sample.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;
constexpr std::uint64_t least_line_bytes = 5;  // "0 0 0"; the last line may lack its end

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

[[noreturn]] void ended_early(const LineReader& lines, std::uint64_t done, std::uint64_t count) {
  lines.fail("the header says " + std::to_string(count) + " points, the file ends after " + std::to_string(done),
             "the file is cut short; copy or export it again");
}

const std::vector<Field>& next_point(LineReader& lines, std::uint64_t done, std::uint64_t count) {
  if (!lines.next_with_text()) ended_early(lines, done, count);
  return lines.fields_between_blanks();
}

/// What stands above the points of a scan.
struct Block {
  std::uint64_t count = 0;
  std::string where;
};

/// The count on the present line.
Block block_at(LineReader& lines) {
  const std::vector<Field>& first = lines.fields_between_blanks();
  if (first.size() != 1)
    lines.fail("the number of points is needed alone on a line", "put it there, or name a file without it .xyz");
  const Block block{lines.count(first[0]), lines.place()};
  lines.file().expect_records(lines.position(), block.count, least_line_bytes, "points");
  if (block.count == 0) throw Error("the scan holds no points", block.where, "export the scan again with its points");
  return block;
}

/// The points below the count on the present line.
void stream_block(LineReader& lines, const std::string& name, const ReadOptions& options, ScanSink& sink,
                  const Progress& progress) {
  const Block block = block_at(lines);
  const std::uint64_t count = block.count;
  const std::size_t values = next_point(lines, 0, count).size();
  PointStream out({name, block.where, attributes_of(lines, values), std::nullopt, count, {}}, options,
                  NanMeans::invalid, sink);
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

/// The same without reading the points.
ScanSummary summary_of_block(LineReader& lines, const std::string& name, const Progress& progress) {
  const Block block = block_at(lines);
  const std::uint64_t begin = lines.position();
  ScanSummary scan;
  scan.name = name;
  scan.points = block.count;
  scan.attributes = attribute_names(attributes_of(lines, next_point(lines, 0, block.count).size()));
  for (std::uint64_t i = 1; i < block.count; ++i) {
    if (i % points_between_checks == 0) progress.step(lines.position(), lines.file().size());
    if (!lines.next_with_text()) ended_early(lines, i, block.count);
  }
  take_sample(scan, sample_lines(lines.file(), begin, lines.position(), {}, block.count));
  return scan;
}

/// Goes to the next count, which stands alone on its line; false at the end of the file.
bool next_block(LineReader& lines, int scans) {
  if (!lines.next_with_text()) {
    if (scans == 0) lines.fail("the file holds no points", "export the scan again with its points");
    return false;
  }
  if (scans > 0 && lines.fields_between_blanks().size() != 1)
    lines.fail("there are more points than the number above them says", "correct that number");
  return true;
}

}  // namespace

void stream_pts(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  LineReader lines(path);
  for (int scans = 0; next_block(lines, scans); ++scans)
    stream_block(lines, name_of_scan(path, scans + 1), options, sink, progress);
}

ScanFileSummary summarise_pts(const std::filesystem::path& path, Progress& progress) {
  LineReader lines(path);
  ScanFileSummary summary;
  summary.format = "PTS";
  for (int scans = 0; next_block(lines, scans); ++scans)
    summary.scans.push_back(summary_of_block(lines, name_of_scan(path, scans + 1), progress));
  return summary;
}

}  // namespace adit::io
