// LAS files whose coordinates are no metres are read as they are, and refused where metres are needed.

#include <cstring>

#include "tests/io/scan_samples.h"
#include "tests/io/scan_streams.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

/// A LAS file with one record of the coordinate system: 34735 for GeoTIFF keys, 2112 for well-known text.
std::string las_with(std::uint16_t number, const std::string& content) {
  const tests::TemporaryFolder folder;
  tests::write_one(folder / "a.las", tests::sample_scan(10));
  std::string bytes = tests::bytes_of(folder / "a.las");
  std::string record("\0\0LASF_Projection\0", 18);
  record.resize(54);
  const auto length = static_cast<std::uint16_t>(content.size());
  std::memcpy(record.data() + 18, &number, 2);
  std::memcpy(record.data() + 20, &length, 2);
  record += content;
  const std::uint32_t records = 1, points = static_cast<std::uint32_t>(375 + record.size());
  std::memcpy(bytes.data() + 96, &points, 4);
  std::memcpy(bytes.data() + 100, &records, 4);
  return bytes.insert(375, record);
}

std::string keys(std::initializer_list<std::uint16_t> numbers) {
  std::string bytes;
  for (const std::uint16_t n : numbers) bytes.append(reinterpret_cast<const char*>(&n), 2);
  return bytes;
}

std::string unit_of(const std::string& las) {
  const tests::TemporaryFolder folder;
  return tests::stream_all(folder.write("b.las", las)).at(0).header.unit;
}

TEST(LasUnit, FromGeotiffKeys) {
  EXPECT_EQ(unit_of(las_with(34735, keys({1, 1, 0, 1, 3076, 0, 1, 9001}))), "");
  EXPECT_EQ(unit_of(las_with(34735, keys({1, 1, 0, 1, 3076, 0, 1, 9002}))), "foot");
  EXPECT_EQ(unit_of(las_with(34735, keys({1, 1, 0, 2, 3076, 0, 1, 9001, 4099, 0, 1, 9003}))), "US survey foot");
  EXPECT_EQ(unit_of(las_with(34735, keys({1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326}))), "degree");
  EXPECT_EQ(unit_of(las_with(34735, keys({1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832}))), "");
}

TEST(LasUnit, FromWellKnownText) {
  const std::string geographic = R"(GEOGCS["WGS 84",DATUM["D",SPHEROID["S",1,2]],UNIT["degree",0.0174]])";
  const auto projected = [&](const std::string& unit) {
    return R"(PROJCS["P",)" + geographic + R"(,PROJECTION["L"],UNIT[")" + unit + R"(",1],AXIS["X",EAST]])";
  };
  EXPECT_EQ(unit_of(las_with(2112, projected("metre"))), "");
  EXPECT_EQ(unit_of(las_with(2112, projected("Metre"))), "");
  EXPECT_EQ(unit_of(las_with(2112, projected("foot"))), "foot");
  EXPECT_EQ(unit_of(las_with(2112, geographic)), "degree");
  EXPECT_EQ(unit_of(las_with(2112, "COMPD_CS[\"C\"," + projected("metre") +
                                       R"(,VERT_CS["V",VERT_DATUM["D",2005],UNIT["US survey foot",0.3]]])")),
            "US survey foot");
  EXPECT_EQ(unit_of(las_with(2112, R"(PROJCRS["P",BASEGEOGCRS["B",ANGLEUNIT["degree",1]],LENGTHUNIT["foot",0.3]])")),
            "foot");
  EXPECT_EQ(unit_of(las_with(2112, R"(PROJCS["cut short",UNIT["foo)")), "");
}

TEST(LasUnit, NoMetresAreRefusedWhereMetresAreNeeded) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("feet.las", las_with(34735, keys({1, 1, 0, 1, 3076, 0, 1, 9002})));
  const ScanHeader header = tests::stream_all(file).at(0).header;
  try {
    expect_metres(header);
    FAIL() << "feet were taken for metres";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("its coordinates are no metres (foot)"));
    EXPECT_THAT(error.what(), HasSubstr("feet.las"));
  }
  expect_metres({});
}

}  // namespace
}  // namespace adit::io
