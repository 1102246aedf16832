#include "io/las_header.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr const char* damaged = "the header is damaged; export the file again";
constexpr std::array<std::uint16_t, 5> header_bytes_of_minor = {227, 227, 227, 235, 375};

struct FormatRow {
  std::uint16_t least_bytes;
  std::uint16_t colour_offset;  // 0: none
};
constexpr std::array<FormatRow, 11> formats = {
    {{20, 0}, {28, 0}, {26, 20}, {34, 28}, {57, 0}, {63, 28}, {30, 0}, {36, 30}, {38, 30}, {59, 0}, {67, 30}}};

/// The bytes of a header, by their place in it.
class HeaderBytes {
 public:
  explicit HeaderBytes(const InputFile& file) : file_(file) {
    if (file.beginning(4) != "LASF")
      throw Error("this is no LAS file (it does not begin with LASF)", file.at_byte(0), "check the file's ending");
    bytes_ = file.read(0, header_bytes_of_minor[0], "the LAS header");
    const unsigned major = at<std::uint8_t>(24);
    const unsigned minor = at<std::uint8_t>(25);
    if (major != 1 || minor >= header_bytes_of_minor.size())
      fail(24, "LAS version " + std::to_string(major) + "." + std::to_string(minor) + " is not known",
           "export as LAS 1.2 or 1.4");
    bytes_ = file.read(0, header_bytes_of_minor[minor], "the LAS header");
    if (at<std::uint16_t>(94) < bytes_.size())
      fail(94,
           "the header says it has " + std::to_string(at<std::uint16_t>(94)) + " bytes, version 1." +
               std::to_string(minor) + " needs " + std::to_string(bytes_.size()),
           damaged);
  }

  template <typename T>
  T at(std::size_t offset) const {
    return little<T>(bytes_.data() + offset);
  }
  Eigen::Vector3d vector(std::size_t offset, std::size_t stride = 8) const {
    return {at<double>(offset), at<double>(offset + stride), at<double>(offset + 2 * stride)};
  }
  [[noreturn]] void fail(std::uint64_t offset, const std::string& what_is_wrong, const std::string& mend) const {
    throw Error(what_is_wrong, file_.at_byte(offset), mend);
  }

 private:
  const InputFile& file_;
  std::vector<std::byte> bytes_;
};

void take_point_format(const HeaderBytes& bytes, LasPoints kept, LasHeader& header) {
  const unsigned marked = bytes.at<std::uint8_t>(104);
  const unsigned stored = marked & 0x3FU;
  const bool compressed = stored != marked;
  if (compressed && kept == LasPoints::plain)
    bytes.fail(104, "the points are compressed (LAZ)", "give the file the ending .laz");
  if (!compressed && kept == LasPoints::compressed)
    bytes.fail(104, "the points are not compressed (LAS)", "give the file the ending .las");
  if (stored >= formats.size())
    bytes.fail(104, "point format " + std::to_string(stored) + " is not known", "export with point format 0 to 8");
  header.point_format = stored;
  header.record_bytes = bytes.at<std::uint16_t>(105);
  if (header.record_bytes < formats[stored].least_bytes)
    bytes.fail(105,
               "point records of " + std::to_string(header.record_bytes) + " bytes; point format " +
                   std::to_string(stored) + " needs " + std::to_string(formats[stored].least_bytes),
               damaged);
}

void take_count(const HeaderBytes& bytes, LasHeader& header) {
  const std::uint64_t legacy = bytes.at<std::uint32_t>(107);
  header.points = legacy;
  if (header.minor_version < 4) return;
  header.points = bytes.at<std::uint64_t>(247);
  if (header.points == 0) header.points = legacy;
  if (legacy != 0 && legacy != header.points)
    bytes.fail(247, "two counts of points, " + std::to_string(legacy) + " and " + std::to_string(header.points),
               damaged);
}

void take_coordinates(const HeaderBytes& bytes, LasHeader& header) {
  header.scale = bytes.vector(131);
  header.offset = bytes.vector(155);
  if (!header.scale.allFinite() || header.scale.minCoeff() <= 0.0)
    bytes.fail(131, "the scale factors are not positive numbers", damaged);
  if (!header.offset.allFinite()) bytes.fail(155, "the offsets are not finite", damaged);
  const Eigen::Vector3d most = bytes.vector(179, 16);
  const Eigen::Vector3d least = bytes.vector(187, 16);
  if (most.allFinite() && least.allFinite() && (most - least).minCoeff() >= 0.0) header.box = BoundingBox(least, most);
}

/// Where the points must end: at waveforms or extended records, or with the file.
std::uint64_t end_of_points(const InputFile& file, const HeaderBytes& bytes, const LasHeader& header) {
  std::uint64_t end = file.size();
  const auto shorten = [&](std::uint64_t start) {
    if (start >= header.points_offset && start < end) end = start;
  };
  if (header.minor_version >= 3) shorten(bytes.at<std::uint64_t>(227));
  if (header.minor_version >= 4 && bytes.at<std::uint32_t>(243) > 0) shorten(bytes.at<std::uint64_t>(235));
  return end;
}

void take_points_offset(const HeaderBytes& bytes, LasHeader& header) {
  header.header_bytes = bytes.at<std::uint16_t>(94);
  header.points_offset = bytes.at<std::uint32_t>(96);
  if (header.points_offset < header.header_bytes)
    bytes.fail(96, "the points begin inside the header, at byte " + std::to_string(header.points_offset), damaged);
  header.records = bytes.at<std::uint32_t>(100);
}

void expect_points(const InputFile& file, const HeaderBytes& bytes, const LasHeader& header) {
  const std::uint64_t end = end_of_points(file, bytes, header);
  const std::uint64_t room = end > header.points_offset ? (end - header.points_offset) / header.record_bytes : 0;
  const std::string counts =
      "the header says " + std::to_string(header.points) + " points, the file holds " + std::to_string(room);
  if (header.points > room) bytes.fail(header.points_offset, counts, "the file is cut short; copy or export it again");
  if (header.points < room)
    bytes.fail(107, counts, "the program that wrote it did not end well; repair the header or export it again");
}

}  // namespace

LasPointFormat las_point_format(unsigned number) {
  const FormatRow& row = formats.at(number);
  LasPointFormat format{row.least_bytes, std::nullopt};
  if (row.colour_offset != 0) format.colour_offset = row.colour_offset;
  return format;
}

LasHeader read_las_header(const InputFile& file, LasPoints kept) {
  const HeaderBytes bytes(file);
  LasHeader header;
  header.minor_version = bytes.at<std::uint8_t>(25);
  take_point_format(bytes, kept, header);
  take_count(bytes, header);
  take_coordinates(bytes, header);
  take_points_offset(bytes, header);
  if (kept == LasPoints::plain) expect_points(file, bytes, header);
  if (header.points == 0) bytes.fail(107, "the scan holds no points", "export the scan again with its points");
  return header;
}

}  // namespace adit::io
