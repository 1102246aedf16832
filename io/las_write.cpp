#include <bit>
#include <cmath>
#include <cstring>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/las.h"
#include "io/outgoing_scan.h"

namespace adit::io {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS files are written as memory holds the numbers");

constexpr std::size_t points_between_checks = 8192;
constexpr std::size_t header_bytes = 375;
constexpr double finest_scale_m = 1e-4;

template <typename T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// A whole-metre middle, and the finest step of powers of ten that keeps every coordinate within 32 bits.
struct Grid {
  Eigen::Vector3d offset;
  double scale_m = finest_scale_m;
};

Grid grid_for(const BoundingBox& box) {
  Grid grid{box.center().array().round(), finest_scale_m};
  const double farthest = (box.max() - grid.offset).cwiseMax(grid.offset - box.min()).maxCoeff();
  while (farthest / grid.scale_m > 2.147e9) grid.scale_m *= 10.0;
  return grid;
}

std::string header_of(const OutgoingScan& scan, const BoundingBox& box, const Grid& grid) {
  const bool colour = scan.cloud().has_colour();
  std::string bytes(header_bytes, '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint16_t>(bytes, 6, 16);  // coordinate system, if any, as well-known text: point formats 6 and up ask for it
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, 4);
  std::memcpy(bytes.data() + 26, "OTHER", 5);
  std::memcpy(bytes.data() + 58, "Adit", 4);
  put<std::uint16_t>(bytes, 94, header_bytes);
  put<std::uint32_t>(bytes, 96, header_bytes);
  put<std::uint8_t>(bytes, 104, colour ? 7 : 6);
  put<std::uint16_t>(bytes, 105, colour ? 36 : 30);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    put(bytes, 131 + 8 * axis, grid.scale_m);
    put(bytes, 155 + 8 * axis, grid.offset[k]);
    put(bytes, 179 + 16 * axis, box.max()[k]);
    put(bytes, 187 + 16 * axis, box.min()[k]);
  }
  put<std::uint64_t>(bytes, 247, scan.size());
  put<std::uint64_t>(bytes, 255, scan.size());  // all of them first returns
  return bytes;
}

void fill_record(std::string& record, const OutgoingScan& scan, std::size_t i, const Grid& grid,
                 const IntensityRange& range) {
  const Eigen::Vector3d steps = (scan.position(i) - grid.offset) / grid.scale_m;
  for (std::size_t axis = 0; axis < 3; ++axis)
    put(record, 4 * axis, static_cast<std::int32_t>(std::lround(steps[static_cast<Eigen::Index>(axis)])));
  const PointCloud& cloud = scan.cloud();
  if (cloud.has_intensity()) put(record, 12, static_cast<std::uint16_t>(std::lround(range(cloud.intensity[i]))));
  put<std::uint8_t>(record, 14, 0x11);  // first return of one
  if (!cloud.has_colour()) return;
  for (std::size_t c = 0; c < 3; ++c) put(record, 30 + 2 * c, static_cast<std::uint16_t>(cloud.colour[i][c] * 257U));
}

}  // namespace

void write_las(const std::filesystem::path& path, const ScanData& scan_data, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {}, path);
  const OutgoingScan scan(scan_data, PoseGoes::into_points, path);
  const BoundingBox box = scan.box();
  const Grid grid = grid_for(box);
  const IntensityRange range = intensity_range(scan.cloud(), 65535.0, true);
  AtomicFile file(path);
  file.append(header_of(scan, box, grid));
  std::string record(scan.cloud().has_colour() ? 36 : 30, '\0');
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    fill_record(record, scan, i, grid, range);
    file.append(record);
  }
  file.commit();
}

}  // namespace adit::io
