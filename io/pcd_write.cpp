#include <algorithm>

#include "core/foundation/error.h"
#include "core/foundation/options.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/pcd.h"
#include "io/pcd_pcl.h"
#include "io/text_row.h"

namespace adit::io {
namespace {

constexpr std::uint64_t most_compressed_bytes = std::uint64_t{256} << 20;

struct WrittenField {
  const char* name;
  char type;
  std::size_t size;
};

std::vector<WrittenField> written_fields(const ScanFacts& scan) {
  const std::size_t coordinate = scan.coordinates_are_float32 ? 4 : 8;
  const Attributes& has = scan.header.attributes;
  std::vector<WrittenField> fields = {{"x", 'F', coordinate}, {"y", 'F', coordinate}, {"z", 'F', coordinate}};
  if (has.intensity) fields.push_back({"intensity", 'F', 4});
  if (has.colour) fields.push_back({"rgb", 'U', 4});
  if (has.normals)
    for (const char* name : {"normal_x", "normal_y", "normal_z"}) fields.push_back({name, 'F', 4});
  return fields;
}

std::size_t record_bytes(const std::vector<WrittenField>& fields) {
  std::size_t bytes = 0;
  for (const WrittenField& field : fields) bytes += field.size;
  return bytes;
}

std::string header_text(const ScanFacts& scan, const std::vector<WrittenField>& fields, const std::string& encoding) {
  std::string names = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
  for (const WrittenField& field : fields) {
    names += std::string(" ") + field.name;
    sizes += " " + std::to_string(field.size);
    types += std::string(" ") + field.type;
    counts += " 1";
  }
  const Pose pose = scan.header.file_pose.value_or(Pose::Identity());
  const Eigen::Quaterniond turn(pose.linear());
  std::string viewpoint = "VIEWPOINT";
  for (const double v :
       {pose.translation().x(), pose.translation().y(), pose.translation().z(), turn.w(), turn.x(), turn.y(), turn.z()})
    viewpoint += " " + short_number(v);
  const std::string n = std::to_string(scan.points);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + names + "\n" + sizes + "\n" + types + "\n" +
         counts + "\nWIDTH " + n + "\nHEIGHT 1\n" + viewpoint + "\nPOINTS " + n + "\nDATA " + encoding + "\n";
}

std::uint32_t packed_colour(const std::array<std::uint8_t, 3>& colour) {
  return std::uint32_t{colour[0]} << 16 | std::uint32_t{colour[1]} << 8 | std::uint32_t{colour[2]};
}

void append_record(std::string& bytes, const PointBlock& block, std::size_t i, bool is_float32) {
  constexpr std::endian order = std::endian::little;
  for (const double c : block.positions[i]) {
    if (is_float32)
      append_stored(bytes, static_cast<float>(c), order);
    else
      append_stored(bytes, c, order);
  }
  if (!block.intensity.empty()) append_stored(bytes, block.intensity[i], order);
  if (!block.colour.empty()) append_stored(bytes, packed_colour(block.colour[i]), order);
  if (!block.normals.empty())
    for (const float c : block.normals[i]) append_stored(bytes, c, order);
}

/// Variants ascii and binary: point after point.
class PcdWriter : public ScanWriter {
 public:
  PcdWriter(const std::filesystem::path& path, const ScanFacts& scan, bool ascii)
      : scan_(scan), ascii_(ascii), file_(path) {}

  bool begin(const ScanHeader&) override {
    file_.append(header_text(scan_, written_fields(scan_), ascii_ ? "ascii" : "binary"));
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (ascii_) {
        append_text(block, i);
      } else {
        record_.clear();
        append_record(record_, block, i, scan_.coordinates_are_float32);
        file_.append(record_);
      }
    }
  }

  void end(std::uint64_t) override {}
  void commit() override { file_.commit(); }

 private:
  void append_text(const PointBlock& block, std::size_t i) {
    line_.clear();
    add_position(line_, block.positions[i], scan_.coordinates_are_float32);
    if (!block.intensity.empty()) line_.add(block.intensity[i]);
    if (!block.colour.empty()) line_.add(packed_colour(block.colour[i]));
    if (!block.normals.empty()) add_normal(line_, block.normals[i]);
    file_.append(line_.ended());
  }

  ScanFacts scan_;
  bool ascii_;
  AtomicFile file_;
  std::string record_;
  TextLine line_;
};

/// A compressed body holds all x, then all y, and so on, so it is gathered whole before it is packed.
class CompressedPcdWriter : public ScanWriter {
 public:
  CompressedPcdWriter(const std::filesystem::path& path, const ScanFacts& scan)
      : scan_(scan), fields_(written_fields(scan)), file_(path) {
    const std::uint64_t most_points = most_compressed_bytes / record_bytes(fields_);
    if (scan.points > most_points)
      throw Error("a compressed PCD of more than " + std::to_string(most_points) + " such points is not written",
                  path.string(), "write the variant binary");
  }

  bool begin(const ScanHeader&) override {
    file_.append(header_text(scan_, fields_, "binary_compressed"));
    columns_.assign(record_bytes(fields_) * static_cast<std::size_t>(scan_.points), '\0');
    return true;
  }

  void take(PointBlock& block) override {
    const auto points = static_cast<std::size_t>(scan_.points);
    for (std::size_t i = 0; i < block.size() && done_ < points; ++i, ++done_) {
      record_.clear();
      append_record(record_, block, i, scan_.coordinates_are_float32);
      std::size_t offset = 0;
      for (const WrittenField& field : fields_) {
        std::memcpy(columns_.data() + offset * points + done_ * field.size, record_.data() + offset, field.size);
        offset += field.size;
      }
    }
  }

  void end(std::uint64_t) override {
    const std::string packed = lzf_packed(columns_);
    std::string sizes;
    append_stored(sizes, static_cast<std::uint32_t>(packed.size()), std::endian::little);
    append_stored(sizes, static_cast<std::uint32_t>(columns_.size()), std::endian::little);
    file_.append(sizes);
    file_.append(packed);
  }
  void commit() override { file_.commit(); }

 private:
  ScanFacts scan_;
  std::vector<WrittenField> fields_;
  AtomicFile file_;
  std::string columns_;
  std::string record_;
  std::size_t done_ = 0;
};

}  // namespace

std::unique_ptr<ScanWriter> make_pcd_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options) {
  if (options.variant == "compressed") return std::make_unique<CompressedPcdWriter>(path, scans.at(0));
  return std::make_unique<PcdWriter>(path, scans.at(0), options.variant == "ascii");
}

}  // namespace adit::io
