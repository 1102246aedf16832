#include "io/pcd.h"

#include <bit>

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string header(const std::string& width, const std::string& height, const std::string& data,
                   const std::string& extra = {}) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + width + "\nHEIGHT " +
         height + "\n" + extra + "DATA " + data + "\n";
}

class PcdVariant : public testing::TestWithParam<const char*> {};

TEST_P(PcdVariant, RoundTripKeepsEveryBit) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(20'000);
  scan.file_pose = tests::sample_pose();
  tests::write_one(folder / "s.pcd", scan, GetParam());
  const ScanData read = tests::read_one(folder / "s.pcd");
  EXPECT_EQ(read.cloud.points, scan.cloud.points);
  EXPECT_EQ(read.cloud.intensity, scan.cloud.intensity);
  EXPECT_EQ(read.cloud.colour, scan.cloud.colour);
  EXPECT_EQ(read.cloud.normals, scan.cloud.normals);
  ASSERT_TRUE(read.file_pose);
  EXPECT_TRUE(read.file_pose->isApprox(*scan.file_pose, 1e-12));
}

TEST_P(PcdVariant, SiteCoordinatesKeepTenthOfMillimetre) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(5'000);
  tests::write_one(folder / "s.pcd", scan, GetParam());
  const ScanData read = tests::read_one(folder / "s.pcd");
  EXPECT_LT(tests::largest_distance_m(read, scan), 1e-4);
  EXPECT_FALSE(read.file_pose);
}

INSTANTIATE_TEST_SUITE_P(Pcd, PcdVariant, testing::Values("ascii", "binary", "compressed"));

TEST(Pcd, ReadsOtherTypesOlderHeadersAndFieldsOfSeveralValues) {
  const tests::TemporaryFolder folder;
  const auto old = folder.write("old.pcd",
                                "VERSION .5\r\nFIELDS x y z\r\nSIZE 4 4 4\r\nTYPE F F F\r\nCOUNT 1 1 1\r\n"
                                "WIDTH 2\r\nPOINTS 2\r\nDATA ascii\r\n1 2 3\r\n4 5 6\r\n");
  EXPECT_EQ(tests::read_one(old).cloud.points[1], Eigen::Vector3f(4, 5, 6));
  const float packed = std::bit_cast<float>(std::uint32_t{0x010203});
  const auto types = folder.write("types.pcd",
                                  "FIELDS tag z y x rgb\nSIZE 1 2 4 8 4\nTYPE U I I F F\nCOUNT 3 1 1 1 1\n"
                                  "WIDTH 1\nHEIGHT 1\nDATA ascii\n9 9 9 -3 2 1.5 " +
                                      std::to_string(std::bit_cast<std::uint32_t>(packed)) + "\n");
  EXPECT_EQ(tests::read_one(types).cloud.points[0], Eigen::Vector3f(1.5, 2, -3));
  std::string record("\x09\x09\x09\xFD\xFF\x02\0\0\0\0\0\0\0\0\0\xF8\x3F\x03\x02\x01\0", 21);
  const auto binary = folder.write("binary.pcd",
                                   "FIELDS tag z y x rgb\nSIZE 1 2 4 8 4\nTYPE U I I F U\nCOUNT 3 1 1 1 1\n"
                                   "WIDTH 1\nHEIGHT 1\nDATA binary\n" +
                                       record);
  const ScanData scan = tests::read_one(binary);
  EXPECT_EQ(scan.cloud.points[0], Eigen::Vector3f(1.5, 2, -3));
  EXPECT_EQ(scan.cloud.colour[0], (std::array<std::uint8_t, 3>{1, 2, 3}));
}

TEST(Pcd, PlacesWithoutReturnAreCounted) {
  const tests::TemporaryFolder folder;
  const ScanData grid =
      tests::read_one(folder.write("grid.pcd", header("2", "2", "ascii") + "1 2 3\nnan nan nan\nnan 1 1\n4 5 6\n"));
  EXPECT_EQ(grid.cloud.size(), 2U);
  EXPECT_EQ(grid.no_returns, 2U);
  const ScanData list = tests::read_one(folder.write("list.pcd", header("2", "1", "ascii") + "1 2 3\nnan nan nan\n"));
  EXPECT_EQ(list.no_returns, 1U);
  const auto partly = folder.write("partly.pcd", header("2", "1", "ascii") + "1 2 3\nnan 1 1\n");
  EXPECT_THAT(tests::refusal(partly), HasSubstr("partly.pcd:11: a point is not finite"));
  EXPECT_EQ(tests::read_one(partly, {.drop_invalid = true}).cloud.size(), 1U);
  const auto infinite = folder.write("inf.pcd", header("1", "2", "ascii") + "1 2 3\ninf nan nan\n");
  EXPECT_EQ(tests::read_one(infinite).no_returns, 1U);
  const auto all_infinite = folder.write("inf2.pcd", header("1", "2", "ascii") + "1 2 3\ninf 1 1\n");
  EXPECT_THAT(tests::refusal(all_infinite), HasSubstr("not finite"));
  const auto nothing = folder.write("nothing.pcd", header("1", "2", "ascii") + "nan nan nan\nnan nan nan\n");
  EXPECT_THAT(tests::refusal(nothing), HasSubstr("holds no points, only 2 places without a return"));
}

TEST(Pcd, BinaryPointsThatAreNotFiniteAreNamed) {
  const tests::TemporaryFolder folder;
  const float one[] = {1, 2, 3, 4, std::numeric_limits<float>::infinity(), 6};
  const std::string body(reinterpret_cast<const char*>(one), sizeof one);
  EXPECT_THAT(tests::refusal(folder.write("b.pcd", header("2", "1", "binary") + body)),
              HasSubstr("b.pcd: point 2: a point is not finite (4, infinite, 6)"));
}

TEST(Pcd, ZerosUpToAPageMayFollowThePoints) {
  const tests::TemporaryFolder folder;
  const std::string points(24, '\1');
  EXPECT_EQ(tests::read_one(folder.write("a.pcd", header("2", "1", "binary") + points + std::string(3928, '\0')))
                .cloud.size(),
            2U);
}

TEST(Pcd, SummaryComesFromTheHeader) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(30);
  scan.file_pose = tests::sample_pose();
  tests::write_one(folder / "s.pcd", scan, "compressed");
  const ScanFileSummary summary = tests::summary(folder / "s.pcd");
  EXPECT_EQ(summary.format, "PCD binary compressed");
  EXPECT_EQ(summary.scans.at(0).points, 30U);
  EXPECT_TRUE(summary.scans[0].pose);
  EXPECT_THAT(summary.scans[0].attributes, ElementsAre("intensity", "colour", "normals"));
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.pcd", bytes));
}

TEST(Pcd, RefusesHeadersThatPromiseTooMuch) {
  EXPECT_THAT(refused(header("1000000000000", "1", "binary")), HasSubstr("too large for a PCD file"));
  EXPECT_THAT(refused(header("4294967295", "4294967297", "binary")), HasSubstr("too large"));
  EXPECT_THAT(refused(header("2000000000", "1", "binary") + "1234"),
              HasSubstr("the header says 2000000000 points, the file has room for 0 at most"));
  EXPECT_THAT(refused(header("2000000000", "1", "ascii") + "1 2 3\n"), HasSubstr("room for 1 at most"));
  EXPECT_THAT(refused(header("2", "1", "binary") + std::string(23, '\0')),
              HasSubstr("the header says 2 points, the file has room for 1 at most"));
  EXPECT_THAT(refused(header("2", "1", "binary") + std::string(36, '\1')),
              HasSubstr("12 bytes more than its header says"));
  EXPECT_THAT(refused(header("2", "1", "binary_compressed") + "1234"), HasSubstr("ends inside the sizes"));
  EXPECT_THAT(refused(header("2", "1", "binary_compressed") + std::string("\xFF\0\0\0\x18\0\0\0abc", 11)),
              HasSubstr("255 compressed bytes"));
  EXPECT_THAT(refused(header("2", "1", "binary_compressed") + std::string("\x03\0\0\0\x19\0\0\0abc", 11)),
              HasSubstr("25 bytes, the header says 2 points of 12 bytes"));
  EXPECT_THAT(refused(header("100000", "1", "binary_compressed") + std::string("\x03\0\0\0\x80\x4F\x12\0abc", 11)),
              HasSubstr("3 compressed bytes cannot hold 1200000"));
  EXPECT_THAT(refused(header("2", "1", "binary_compressed") + std::string("\x03\0\0\0\x18\0\0\0\xFF\xFF\xFF", 11)),
              HasSubstr("the points cannot be unpacked"));
}

TEST(Pcd, RefusesBrokenHeaders) {
  EXPECT_THAT(refused("FIELDS x y z\nSIZE 4 4\n"), HasSubstr("bad.pcd:2: the line has 2 values for 3 fields"));
  EXPECT_THAT(refused("FIELDS x y z\nSIZE 4 4 3\n"), HasSubstr("a field cannot have 3 bytes"));
  EXPECT_THAT(refused("FIELDS x y z\nSIZE 4 4 4\nTYPE F F G\n"), HasSubstr("bad.pcd:3: unknown type \"G\""));
  EXPECT_THAT(refused("FIELDS x y z\nSIZE 4 4 2\nTYPE F F F\n"), HasSubstr("a float cannot have 2 bytes"));
  EXPECT_THAT(refused("FIELDS x y z\nCOUNT 1 1 0\n"), HasSubstr("a field cannot have 0 values"));
  EXPECT_THAT(refused("WIDTH two\n"), HasSubstr("a whole number is needed, found \"two\""));
  EXPECT_THAT(refused("WIDTH 1\nsolid\n"), HasSubstr("unknown header line \"solid\""));
  EXPECT_THAT(refused(header("1", "1", "ascii", "POINTS 2\n") + "1 2 3\n"),
              HasSubstr("POINTS 2 is not WIDTH times HEIGHT, 1"));
  EXPECT_THAT(refused(header("1", "1", "ascii", "VIEWPOINT 0 0 0 1 0 0\n") + "1 2 3\n"),
              HasSubstr("a VIEWPOINT needs seven numbers"));
  EXPECT_THAT(refused(header("1", "1", "ascii", "VIEWPOINT 0 0 0 2 0 0 0\n") + "1 2 3\n"),
              HasSubstr("has not the length 1"));
  EXPECT_THAT(refused(header("1", "1", "zipped")), HasSubstr("unknown DATA \"zipped\""));
  EXPECT_THAT(refused(header("0", "1", "ascii")), HasSubstr("the scan holds no points"));
  EXPECT_THAT(refused("FIELDS x y\nWIDTH 1\nDATA ascii\n1 2\n"), HasSubstr("the points have no z"));
  EXPECT_THAT(refused("FIELDS x y z x\nWIDTH 1\nDATA ascii\n1 2\n"), HasSubstr("the field x is there twice"));
  EXPECT_THAT(refused("WIDTH 1\n"), HasSubstr("the header has no DATA line"));
}

TEST(Pcd, RefusesBrokenPointsWithTheirPlace) {
  const std::string two = header("2", "1", "ascii") + "1 2 3\n";
  EXPECT_THAT(refused(two + "4 5 six\n"), HasSubstr("bad.pcd:11:5: a number is needed, found \"six\""));
  EXPECT_THAT(refused(two + "4 5\n  "), HasSubstr("bad.pcd:11: the line has 2 values, the header says 3"));
  EXPECT_THAT(refused(two + "         "), HasSubstr("the header says 2 points, the file ends after 1"));
  EXPECT_THAT(refused(two + "4 5 6\n7 8 9\n"), HasSubstr("more points than the header says"));
}

}  // namespace
}  // namespace adit::io
