#include <bit>
#include <cstring>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/atomic_file.h"
#include "io/outgoing_scan.h"
#include "io/pcd.h"
#include "io/pcd_pcl.h"
#include "io/text_line.h"

namespace adit::io {
namespace {

static_assert(std::endian::native == std::endian::little, "PCD files are written as memory holds the numbers");

constexpr std::size_t points_between_checks = 8192;
constexpr std::uint64_t most_compressed_bytes = 3'900'000'000;  // both sizes of a compressed body have 32 bits
constexpr int decimals = 5;                                     // a hundredth of a millimetre

struct WrittenField {
  const char* name;
  char type;
  std::size_t size;
};

std::vector<WrittenField> written_fields(const OutgoingScan& scan) {
  const std::size_t coordinate = scan.is_float32() ? 4 : 8;
  std::vector<WrittenField> fields = {{"x", 'F', coordinate}, {"y", 'F', coordinate}, {"z", 'F', coordinate}};
  if (scan.cloud().has_intensity()) fields.push_back({"intensity", 'F', 4});
  if (scan.cloud().has_colour()) fields.push_back({"rgb", 'U', 4});
  if (scan.cloud().has_normals())
    for (const char* name : {"normal_x", "normal_y", "normal_z"}) fields.push_back({name, 'F', 4});
  return fields;
}

std::string header_text(const OutgoingScan& scan, const std::vector<WrittenField>& fields, const Pose& pose,
                        const std::string& encoding) {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const WrittenField& field : fields) {
    names += std::string(" ") + field.name;
    sizes += " " + std::to_string(field.size);
    types += std::string(" ") + field.type;
    counts += " 1";
  }
  const Eigen::Quaterniond turn(pose.linear());
  std::string viewpoint = "VIEWPOINT";
  for (const double v :
       {pose.translation().x(), pose.translation().y(), pose.translation().z(), turn.w(), turn.x(), turn.y(), turn.z()})
    viewpoint += " " + short_number(v);
  const std::string n = std::to_string(scan.size());
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + names + "\n" + sizes + "\n" + types + "\n" +
         counts + "\nWIDTH " + n + "\nHEIGHT 1\n" + viewpoint + "\nPOINTS " + n + "\nDATA " + encoding + "\n";
}

std::uint32_t packed_colour(const std::array<std::uint8_t, 3>& colour) {
  return std::uint32_t{colour[0]} << 16 | std::uint32_t{colour[1]} << 8 | std::uint32_t{colour[2]};
}

template <typename T>
void add_stored(std::string& bytes, T value) {
  char stored[sizeof(T)];
  std::memcpy(stored, &value, sizeof(T));
  bytes.append(stored, sizeof(T));
}

void add_record(std::string& bytes, const OutgoingScan& scan, std::size_t i) {
  const PointCloud& cloud = scan.cloud();
  if (scan.is_float32())
    for (const float c : cloud.points[i]) add_stored(bytes, c);
  else
    for (const double c : scan.position(i)) add_stored(bytes, c);
  if (cloud.has_intensity()) add_stored(bytes, cloud.intensity[i]);
  if (cloud.has_colour()) add_stored(bytes, packed_colour(cloud.colour[i]));
  if (cloud.has_normals())
    for (const float c : scan.normal(i)) add_stored(bytes, c);
}

void add_text(TextLine& line, const OutgoingScan& scan, std::size_t i) {
  const PointCloud& cloud = scan.cloud();
  if (scan.is_float32())
    for (const float c : cloud.points[i]) line.add(c);
  else
    for (const double c : scan.position(i)) line.add(c, decimals);
  if (cloud.has_intensity()) line.add(cloud.intensity[i]);
  if (cloud.has_colour()) line.add(packed_colour(cloud.colour[i]));
  if (cloud.has_normals())
    for (const float c : scan.normal(i)) line.add(c);
}

void append_rows(AtomicFile& file, const OutgoingScan& scan, bool ascii, const Progress& progress) {
  TextLine line;
  std::string record;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    line.clear();
    record.clear();
    if (ascii)
      add_text(line, scan, i);
    else
      add_record(record, scan, i);
    file.append(ascii ? line.ended() : record);
  }
}

/// A compressed body holds all x, then all y, and so on.
void append_compressed(AtomicFile& file, const OutgoingScan& scan, const std::vector<WrittenField>& fields,
                       const Progress& progress) {
  std::size_t record_bytes = 0;
  for (const WrittenField& field : fields) record_bytes += field.size;
  std::string columns(record_bytes * scan.size(), '\0');
  std::string record;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (i % points_between_checks == 0) progress.step(i, scan.size());
    record.clear();
    add_record(record, scan, i);
    std::size_t offset = 0;
    for (const WrittenField& field : fields) {
      std::memcpy(columns.data() + offset * scan.size() + i * field.size, record.data() + offset, field.size);
      offset += field.size;
    }
  }
  const std::string packed = lzf_packed(columns);
  std::string sizes;
  add_stored(sizes, static_cast<std::uint32_t>(packed.size()));
  add_stored(sizes, static_cast<std::uint32_t>(columns.size()));
  file.append(sizes);
  file.append(packed);
}

}  // namespace

void write_pcd(const std::filesystem::path& path, const ScanData& scan_data, const WriteOptions& options,
               Progress& progress) {
  expect_variant(options, {"ascii", "binary", "compressed"}, path);
  const OutgoingScan scan(scan_data, PoseGoes::beside_points, path);
  const std::vector<WrittenField> fields = written_fields(scan);
  std::uint64_t record_bytes = 0;
  for (const WrittenField& field : fields) record_bytes += field.size;
  const bool compressed = options.variant == "compressed";
  if (compressed && record_bytes * scan.size() > most_compressed_bytes)
    throw Error("a compressed PCD file cannot hold so many points", path.string(), "write the variant binary");
  AtomicFile file(path);
  const Pose pose = scan_data.file_pose.value_or(Pose::Identity());
  const std::string encoding = compressed ? "binary_compressed" : options.variant.empty() ? "binary" : options.variant;
  file.append(header_text(scan, fields, pose, encoding));
  if (compressed)
    append_compressed(file, scan, fields, progress);
  else
    append_rows(file, scan, encoding == "ascii", progress);
  file.commit();
}

}  // namespace adit::io
