#include "io/las.h"

#include <cstring>

#include "io/las_header.h"
#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

/// A file with two points, byte by byte as the specification of the American Society for Photogrammetry says.
std::string las_file(unsigned minor, unsigned point_format, std::uint16_t extra_bytes = 0) {
  const std::size_t header_bytes = minor == 4 ? 375 : minor == 3 ? 235 : 227;
  const LasPointFormat format = las_point_format(point_format);
  const std::size_t record = std::size_t{format.least_bytes} + extra_bytes;
  std::string bytes(header_bytes + 2 * record, '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, static_cast<std::uint8_t>(minor));
  put<std::uint16_t>(bytes, 94, static_cast<std::uint16_t>(header_bytes));
  put<std::uint32_t>(bytes, 96, static_cast<std::uint32_t>(header_bytes));
  put<std::uint8_t>(bytes, 104, static_cast<std::uint8_t>(point_format));
  put<std::uint16_t>(bytes, 105, static_cast<std::uint16_t>(record));
  if (minor < 4) put<std::uint32_t>(bytes, 107, 2);
  if (minor == 4) put<std::uint64_t>(bytes, 247, 2);
  for (const std::size_t offset : {131U, 139U, 147U}) put(bytes, offset, 0.001);
  put(bytes, 155, 612000.0);
  put(bytes, 163, 6998000.0);
  put(bytes, 171, 400.0);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t at = header_bytes + i * record;
    put<std::int32_t>(bytes, at, 345125 + static_cast<std::int32_t>(i));
    put<std::int32_t>(bytes, at + 4, 765250);
    put<std::int32_t>(bytes, at + 8, -12375);
    put<std::uint16_t>(bytes, at + 12, static_cast<std::uint16_t>(1000 + i));
    if (format.colour_offset)
      for (std::size_t c = 0; c < 3; ++c)
        put<std::uint16_t>(bytes, at + *format.colour_offset + 2 * c, static_cast<std::uint16_t>(256 * (c + 1)));
  }
  return bytes;
}

TEST(Las, ReadsEveryPointFormat) {
  const tests::TemporaryFolder folder;
  for (unsigned format = 0; format <= 10; ++format) {
    for (const std::uint16_t extra : {0, 7}) {
      const unsigned minor = format >= 6 ? 4 : format >= 4 ? 3 : 2;
      const ScanData scan = tests::read_one(folder.write("a.las", las_file(minor, format, extra)));
      ASSERT_EQ(scan.cloud.size(), 2U) << format;
      const Eigen::Vector3d first = scan.cloud.points[0].cast<double>() + scan.offset;
      EXPECT_LT((first - Eigen::Vector3d(612345.125, 6998765.25, 387.625)).norm(), 1e-6);
      EXPECT_EQ(scan.cloud.intensity[1], 1001.0F);
      EXPECT_EQ(scan.cloud.has_colour(), las_point_format(format).colour_offset.has_value());
      if (scan.cloud.has_colour()) {
        EXPECT_EQ(scan.cloud.colour[0], (std::array<std::uint8_t, 3>{1, 2, 3}));
      }
    }
  }
}

TEST(Las, ReadsEveryVersion) {
  const tests::TemporaryFolder folder;
  for (unsigned minor = 0; minor <= 4; ++minor) {
    const auto file = folder.write("a.las", las_file(minor, 0));
    EXPECT_EQ(tests::read_one(file).cloud.size(), 2U);
    EXPECT_EQ(tests::summary(file).format, "LAS 1." + std::to_string(minor) + " point format 0");
  }
}

TEST(Las, PlainByteColoursAreKept) {
  const tests::TemporaryFolder folder;
  std::string bytes = las_file(2, 2);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t c = 0; c < 3; ++c) put<std::uint16_t>(bytes, 227 + 26 * i + 20 + 2 * c, 200);
  EXPECT_EQ(tests::read_one(folder.write("a.las", bytes)).cloud.colour[0],
            (std::array<std::uint8_t, 3>{200, 200, 200}));
}

TEST(Las, RoundTrip) {
  const tests::TemporaryFolder folder;
  for (const bool colour : {false, true}) {
    ScanData scan = tests::sample_scan_at_site(20'000);
    if (!colour) scan.cloud.colour.clear();
    tests::write_one(folder / "s.las", scan);
    const ScanData read = tests::read_one(folder / "s.las");
    EXPECT_LT(tests::largest_distance_m(read, scan), 1e-4);  // half a step of 0.1 mm on each axis is 0.087 mm
    EXPECT_EQ(read.cloud.intensity, scan.cloud.intensity);
    EXPECT_EQ(read.cloud.colour, scan.cloud.colour);
    const ScanFileSummary summary = tests::summary(folder / "s.las");
    EXPECT_EQ(summary.format, colour ? "LAS 1.4 point format 7" : "LAS 1.4 point format 6");
    EXPECT_LT((summary.scans.at(0).box.center() - scan.offset).norm(), 1.0);
  }
}

TEST(Las, StepGrowsWhereTenthsOfMillimetresOverflow) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{-240'000, 0, 0}, {240'000, 0, 1}};
  tests::write_one(folder / "s.las", scan);
  const std::string bytes = tests::bytes_of(folder / "s.las");
  EXPECT_EQ(little<double>(reinterpret_cast<const std::byte*>(bytes.data()) + 131), 1e-3);
}

TEST(Las, FractionsOfIntensityFillTheRange) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  scan.cloud.intensity = {0.0F, 0.5F, 1.0F};
  tests::write_one(folder / "s.las", scan);
  EXPECT_THAT(tests::read_one(folder / "s.las").cloud.intensity, ElementsAre(0.0F, 32768.0F, 65535.0F));
  scan.cloud.intensity = {-1300.0F, -1000.0F, -700.0F};
  tests::write_one(folder / "s.las", scan);
  EXPECT_THAT(tests::read_one(folder / "s.las").cloud.intensity, ElementsAre(0.0F, 32768.0F, 65535.0F));
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.las", bytes));
}

template <typename T>
std::string refused_with(unsigned minor, unsigned format, std::size_t offset, T value) {
  std::string bytes = las_file(minor, format);
  put(bytes, offset, value);
  return refused(bytes);
}

TEST(Las, RefusesCountsThatTheFileDoesNotHold) {
  std::string one_short = las_file(2, 3);
  one_short.resize(one_short.size() - 1);
  EXPECT_THAT(refused(one_short),
              AllOf(HasSubstr("bad.las: byte 227"), HasSubstr("the header says 2 points, the file holds 1;")));
  EXPECT_THAT(refused_with<std::uint32_t>(2, 0, 107, 4'000'000'000),
              HasSubstr("the header says 4000000000 points, the file holds 2"));
  EXPECT_THAT(refused_with<std::uint64_t>(4, 6, 247, ~std::uint64_t{0}), HasSubstr("the file holds 2;"));
  EXPECT_THAT(refused_with<std::uint32_t>(2, 0, 107, 1), HasSubstr("the header says 1 points, the file holds 2"));
  EXPECT_THAT(refused_with<std::uint32_t>(4, 6, 107, 3), HasSubstr("two counts of points, 3 and 2"));
  std::string none = las_file(2, 0).substr(0, 227);
  put<std::uint32_t>(none, 107, 0);
  EXPECT_THAT(refused(none), HasSubstr("the scan holds no points"));
}

TEST(Las, RefusesBrokenHeaders) {
  EXPECT_THAT(refused("LASX" + std::string(300, '\0')), HasSubstr("this is no LAS file"));
  EXPECT_THAT(refused(las_file(2, 0).substr(0, 200)), HasSubstr("ends inside the LAS header"));
  EXPECT_THAT(refused_with<std::uint8_t>(2, 0, 25, 5), HasSubstr("LAS version 1.5 is not known"));
  EXPECT_THAT(refused_with<std::uint8_t>(2, 0, 104, 11), HasSubstr("point format 11 is not known"));
  EXPECT_THAT(refused_with<std::uint8_t>(2, 0, 104, 0x80),
              testing::AnyOf(HasSubstr("the record of LASzip is missing"), HasSubstr("has no LAZ")));
  EXPECT_THAT(refused_with<std::uint16_t>(2, 0, 105, 19),
              HasSubstr("point records of 19 bytes; point format 0 needs 20"));
  EXPECT_THAT(refused_with<std::uint16_t>(2, 0, 94, 226), HasSubstr("the header says it has 226 bytes"));
  EXPECT_THAT(refused_with<std::uint32_t>(2, 0, 96, 100), HasSubstr("the points begin inside the header"));
  EXPECT_THAT(refused_with<std::uint32_t>(2, 0, 96, 0xFFFFFFFF), HasSubstr("the file holds 0"));
  EXPECT_THAT(refused_with<double>(2, 0, 139, 0.0), HasSubstr("the scale factors are not positive"));
  EXPECT_THAT(refused_with<double>(2, 0, 139, std::nan("")), HasSubstr("the scale factors"));
  EXPECT_THAT(refused_with<double>(2, 0, 163, INFINITY), HasSubstr("the offsets are not finite"));
  EXPECT_THAT(refused_with<double>(2, 0, 131, 1e300), HasSubstr("is no site coordinate"));
  EXPECT_THAT(refused_with<double>(2, 0, 131, 1e6), HasSubstr("no site coordinate"));
}

}  // namespace
}  // namespace adit::io
