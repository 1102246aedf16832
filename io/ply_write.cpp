#include <algorithm>
#include <bit>
#include <cstring>

#include "io/atomic_file.h"
#include "io/outgoing_scan.h"
#include "io/ply.h"
#include "io/text_line.h"

namespace adit::io {
namespace {

constexpr std::size_t points_between_checks = 8192;
constexpr int decimals = 5;  // a hundredth of a millimetre

std::string header_text(const OutgoingScan& scan, const std::string& encoding) {
  const std::string coordinate = scan.is_float32() ? "property float " : "property double ";
  std::string text = "ply\nformat " + encoding + " 1.0\ncomment written by Adit, metres\nelement vertex " +
                     std::to_string(scan.size()) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += coordinate + axis + "\n";
  if (scan.cloud().has_intensity()) text += "property float intensity\n";
  if (scan.cloud().has_colour()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (scan.cloud().has_normals()) text += "property float nx\nproperty float ny\nproperty float nz\n";
  return text + "end_header\n";
}

template <typename T>
void add_stored(std::string& bytes, T value, bool big) {
  char stored[sizeof(T)];
  std::memcpy(stored, &value, sizeof(T));
  if (big != (std::endian::native == std::endian::big)) std::reverse(stored, stored + sizeof(T));
  bytes.append(stored, sizeof(T));
}

void add_binary_row(std::string& bytes, const OutgoingScan& scan, std::size_t i, bool big) {
  const PointCloud& cloud = scan.cloud();
  if (scan.is_float32())
    for (const float c : cloud.points[i]) add_stored(bytes, c, big);
  else
    for (const double c : scan.position(i)) add_stored(bytes, c, big);
  if (cloud.has_intensity()) add_stored(bytes, cloud.intensity[i], big);
  if (cloud.has_colour())
    for (const std::uint8_t c : cloud.colour[i]) add_stored(bytes, c, big);
  if (cloud.has_normals())
    for (const float c : scan.normal(i)) add_stored(bytes, c, big);
}

void add_text_row(TextLine& line, const OutgoingScan& scan, std::size_t i) {
  const PointCloud& cloud = scan.cloud();
  if (scan.is_float32())
    for (const float c : cloud.points[i]) line.add(c);
  else
    for (const double c : scan.position(i)) line.add(c, decimals);
  if (cloud.has_intensity()) line.add(cloud.intensity[i]);
  if (cloud.has_colour())
    for (const std::uint8_t c : cloud.colour[i]) line.add(unsigned{c});
  if (cloud.has_normals())
    for (const float c : scan.normal(i)) line.add(c);
}

}  // namespace

void write_ply(const std::filesystem::path& path, const ScanData& scan_data, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {"ascii", "little", "big"}, path);
  const OutgoingScan scan(scan_data, PoseGoes::into_points, path);
  const bool ascii = options.variant == "ascii";
  const bool big = options.variant == "big";
  AtomicFile file(path);
  file.append(header_text(scan, ascii ? "ascii" : big ? "binary_big_endian" : "binary_little_endian"));
  TextLine line;
  std::string row;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    if (ascii) {
      line.clear();
      add_text_row(line, scan, i);
      file.append(line.ended());
    } else {
      row.clear();
      add_binary_row(row, scan, i, big);
      file.append(row);
    }
  }
  file.commit();
}

}  // namespace adit::io
