#include <cmath>
#include <limits>

#include "io/e57.h"
#include "io/e57_pages.h"
#include "io/e57_scan_e57format.h"
#include "io/point_stream.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;
/// So many at a time stay near the processor; the wish to stop is heard after each block.
constexpr std::size_t records_in_block = 8192;

/// Columns of a block of records, as doubles whatever the file stores.
class Records {
 public:
  Records(const e57::ImageFile& file, const E57Scan& scan) : reader_(open(file, scan)) {}

  /// The next block: how many records it has; 0 at the end.
  std::size_t next() { return reader_.read(); }
  double operator()(E57Field field, std::size_t i) const { return columns_[field][i]; }

 private:
  e57::CompressedVectorReader open(const e57::ImageFile& file, const E57Scan& scan) {
    std::vector<e57::SourceDestBuffer> buffers;
    for (std::size_t field = 0; field < e57_fields; ++field) {
      if (!scan.has[field]) continue;
      columns_[field].resize(records_in_block);
      buffers.emplace_back(file, e57_field_names[field], columns_[field].data(), records_in_block, true, true);
    }
    return e57::CompressedVectorNode(scan.records).reader(buffers);
  }

  std::array<std::vector<double>, e57_fields> columns_;
  e57::CompressedVectorReader reader_;
};

Eigen::Vector3d from_spherical(double range, double azimuth, double elevation) {
  const double flat = range * std::cos(elevation);
  return {flat * std::cos(azimuth), flat * std::sin(azimuth), range * std::sin(elevation)};
}

std::uint8_t byte_of(double value, const E57ColourRange& range) {
  const double byte = (value - range.least) * range.to_bytes;
  return byte > 0.0 ? static_cast<std::uint8_t>(std::lround(std::min(byte, 255.0))) : std::uint8_t{0};
}

std::uint32_t grid_number(double value, const char* word, const std::string& where) {
  if (!(value >= 0.0 && value <= std::numeric_limits<std::uint32_t>::max()))
    throw Error("a " + std::string(word) + " of the raster is negative or too large", where, "export the scan again");
  return static_cast<std::uint32_t>(value);
}

/// A point of a block.
FilePoint point_of(const E57Scan& scan, const Records& records, std::size_t i) {
  const Attributes& has = scan.header.attributes;
  FilePoint point;
  point.position = scan.spherical
                       ? from_spherical(records(e57_range, i), records(e57_azimuth, i), records(e57_elevation, i))
                       : Eigen::Vector3d(records(e57_x, i), records(e57_y, i), records(e57_z, i));
  if (has.intensity && !(scan.has[e57_intensity_invalid] && records(e57_intensity_invalid, i) != 0.0))
    point.intensity = static_cast<float>(records(e57_intensity, i));
  if (has.colour && !(scan.has[e57_colour_invalid] && records(e57_colour_invalid, i) != 0.0))
    point.colour = {byte_of(records(e57_red, i), scan.colours[0]), byte_of(records(e57_green, i), scan.colours[1]),
                    byte_of(records(e57_blue, i), scan.colours[2])};
  if (has.normals)
    point.normal =
        Eigen::Vector3d(records(e57_normal_x, i), records(e57_normal_y, i), records(e57_normal_z, i)).cast<float>();
  if (has.grid)
    point.grid = {grid_number(records(e57_row, i), "row", scan.header.where),
                  grid_number(records(e57_column, i), "column", scan.header.where)};
  return point;
}

void stream_scan(const fs::path& path, const e57::ImageFile& file, const E57Scan& scan, PointStream& out,
                 const Progress& progress) {
  const E57Field state = scan.spherical ? e57_spherical_invalid : e57_invalid;
  const bool may_be_invalid = scan.has[state];
  if (scan.header.points == 0) return;  // there may be no packet that a reader could begin with
  const InputFile pages(path);
  E57PageCheck check(pages, e57_records_part(pages, scan.records_begin));
  check.ahead_of(0.0);
  Records records(file, scan);
  std::uint64_t done = 0;
  for (std::size_t n = 0; (n = records.next()) > 0; done += n) {
    progress.step(done, scan.header.points);
    check.ahead_of(static_cast<double>(done) / static_cast<double>(scan.header.points));
    for (std::size_t i = 0; i < n; ++i) {
      if (may_be_invalid && records(state, i) != 0.0) {
        out.add_no_return();  // 1: only the direction is known, 2: nothing
      } else {
        out.add(point_of(scan, records, i),
                [&] { return scan.header.where + ": point " + std::to_string(done + i + 1); });
      }
    }
  }
  check.rest();
  if (done != scan.header.points)
    throw Error(
        "the XML says " + std::to_string(scan.header.points) + " points, the file holds " + std::to_string(done),
        scan.header.where, "the file is damaged; copy or export it again");
}

}  // namespace

bool e57_is_built_in() {
  return true;
}

void stream_e57(const fs::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  with_e57_errors(path, [&] {
    const OpenE57 file = open_e57(path);
    const std::vector<E57Scan> scans = e57_scans(file, path);
    for (const E57Scan& scan : scans) {
      const Progress part = progress.part(1.0 / static_cast<double>(scans.size()), "reading " + scan.header.name);
      PointStream out(scan.header, options, NanMeans::no_return_if_all, sink);
      if (out.wanted()) stream_scan(path, file.library, scan, out, part);
      out.end();
    }
  });
}

ScanFileSummary summarise_e57(const fs::path& path, Progress&) {
  return with_e57_errors(path, [&] {
    const OpenE57 file = open_e57(path);
    ScanFileSummary summary;
    summary.format = "E57 1.0";
    summary.header = e57_description(file.library);
    for (const E57Scan& scan : e57_scans(file, path)) {
      ScanSummary row;
      row.name = scan.header.name;
      row.points = scan.header.points;
      row.pose = scan.header.file_pose;
      row.box = scan.header.box;
      if (!row.box.isEmpty()) row.box_from = "header";
      row.attributes = attribute_names(scan.header.attributes);
      row.rows = scan.rows;
      row.columns = scan.columns;
      summary.scans.push_back(row);
    }
    return summary;
  });
}

}  // namespace adit::io
