#include "io/ply.h"

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string ascii_xyz = "ply\nformat ascii 1.0\nelement vertex ";
const std::string float_xyz = "\nproperty float x\nproperty float y\nproperty float z\n";

class PlyVariant : public testing::TestWithParam<const char*> {};

TEST_P(PlyVariant, RoundTripKeepsEveryBit) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(20'000);
  tests::write_one(folder / "s.ply", scan, GetParam());
  const ScanData read = tests::read_one(folder / "s.ply");
  EXPECT_EQ(read.name, "s");
  EXPECT_EQ(read.cloud.points, scan.cloud.points);
  EXPECT_EQ(read.cloud.intensity, scan.cloud.intensity);
  EXPECT_EQ(read.cloud.colour, scan.cloud.colour);
  EXPECT_EQ(read.cloud.normals, scan.cloud.normals);
  EXPECT_TRUE(read.offset.isZero());
  EXPECT_FALSE(read.file_pose);
}

TEST_P(PlyVariant, SiteCoordinatesKeepTenthOfMillimetre) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(5'000);
  tests::write_one(folder / "s.ply", scan, GetParam());
  const ScanData read = tests::read_one(folder / "s.ply");
  EXPECT_LT(tests::largest_distance_m(read, scan), 1e-4);
  EXPECT_EQ(read.offset, Eigen::Vector3d(read.offset.array().round()));
}

TEST_P(PlyVariant, PoseGoesIntoThePoints) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(100);
  scan.file_pose = tests::sample_pose();
  tests::write_one(folder / "s.ply", scan, GetParam());
  const ScanData read = tests::read_one(folder / "s.ply");
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Vector3d at_site = *scan.file_pose * scan.cloud.points[i].cast<double>();
    EXPECT_LT((read.cloud.points[i].cast<double>() - at_site).norm(), 2e-5);
    const Eigen::Vector3f normal = scan.file_pose->linear().cast<float>() * scan.cloud.normals[i];
    EXPECT_LT((read.cloud.normals[i] - normal).norm(), 1e-5F);
  }
}

INSTANTIATE_TEST_SUITE_P(Ply, PlyVariant, testing::Values("ascii", "little", "big"));

TEST(Ply, PassesOverOtherElementsAndLists) {
  const tests::TemporaryFolder folder;
  const std::string header =
      "1.0\ncomment any\nelement camera 2\nproperty list uchar int view\nproperty float f\nelement vertex 2\n"
      "property double x\nproperty list uchar short tags\nproperty short y\nproperty int z\nproperty char blue\n"
      "property uchar red\nproperty ushort green\nproperty float scalar_Intensity\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const auto ascii = folder.write("a.ply", "ply\r\nformat ascii " + header +
                                               "3 1 2 3 0.5\n0 0.5\n1.5 2 7 8 -2 3 64 10 5120 0.25\n"
                                               "2.5 0 4 5 -1 20 256 0.5\n3 0 1 1\n");
  std::string body(
      "\x01"
      "\0\0\0\x07"
      "\0\0\0\0"
      "\0"
      "\0\0\0\0",
      14);  // a camera with one view, one without
  body += std::string(
      "\x3F\xF8\0\0\0\0\0\0"
      "\x02\0\x07\0\x08"
      "\xFF\xFE"
      "\0\0\0\x03"
      "\x40"
      "\x0A"
      "\x14\0"
      "\x3E\x80\0\0",
      27);
  body += std::string(
      "\x40\x04\0\0\0\0\0\0"
      "\0"
      "\0\x04"
      "\0\0\0\x05"
      "\xFF"
      "\x14"
      "\x01\0"
      "\x3F\0\0\0",
      23);
  body += std::string(
      "\x03"
      "\0\0\0\0"
      "\0\0\0\1"
      "\0\0\0\1",
      13);
  const auto big = folder.write("b.ply", "ply\nformat binary_big_endian " + header + body);
  for (const auto& file : {ascii, big}) {
    const ScanData scan = tests::read_one(file);
    EXPECT_THAT(scan.cloud.points, ElementsAre(Eigen::Vector3f(1.5, -2, 3), Eigen::Vector3f(2.5, 4, 5))) << file;
    EXPECT_THAT(scan.cloud.intensity, ElementsAre(0.25F, 0.5F));
    EXPECT_EQ(scan.cloud.colour[0], (std::array<std::uint8_t, 3>{10, 20, 64}));
    EXPECT_EQ(scan.cloud.colour[1], (std::array<std::uint8_t, 3>{20, 1, 255}));
    EXPECT_FALSE(scan.cloud.has_normals());
  }
}

TEST(Ply, ColourFractionsBecomeBytes) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("a.ply", ascii_xyz + "1" + float_xyz +
                                              "property float red\nproperty float green\nproperty float blue\n"
                                              "end_header\n1 2 3 0 0.5 1\n");
  EXPECT_EQ(tests::read_one(file).cloud.colour[0], (std::array<std::uint8_t, 3>{0, 128, 255}));
}

TEST(Ply, SummaryComesFromTheHeader) {
  const tests::TemporaryFolder folder;
  tests::write_one(folder / "s.ply", tests::sample_scan(30), "big");
  const ScanFileSummary summary = tests::summary(folder / "s.ply");
  EXPECT_EQ(summary.format, "PLY binary big endian");
  EXPECT_EQ(summary.scans.at(0).points, 30U);
  EXPECT_THAT(summary.scans[0].attributes, ElementsAre("intensity", "colour", "normals"));
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.ply", bytes));
}

TEST(Ply, RefusesHeadersThatPromiseTooMuch) {
  const std::string little = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  EXPECT_THAT(refused(little + "1000000000000" + float_xyz + "end_header\n" + std::string(24, '\0')),
              HasSubstr("the header says 1000000000000 points, the file has room for 2 at most"));
  EXPECT_THAT(refused(little + "18446744073709551615" + float_xyz + "end_header\n"), HasSubstr("room for 0 at most"));
  EXPECT_THAT(refused(little + "99999999999999999999" + float_xyz + "end_header\n"), HasSubstr("a count is needed"));
  EXPECT_THAT(refused(ascii_xyz + "1000000000000" + float_xyz + "end_header\n1 2 3\n"),
              HasSubstr("room for 1 at most"));
  EXPECT_THAT(refused(little + "2" + float_xyz + "end_header\n" + std::string(23, '\0')),
              HasSubstr("the header says 2 points, the file has room for 1 at most"));
  EXPECT_THAT(refused(little + "2" + float_xyz + "end_header\n" + std::string(36, '\0')),
              HasSubstr("12 bytes more than its header says (2 points of 12 bytes)"));
  EXPECT_THAT(refused("ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint double v\n"
                      "element vertex 1" +
                      float_xyz + "end_header\n" + std::string(4, '\xFF') + std::string(40, '\0')),
              HasSubstr("more bytes are needed"));
}

TEST(Ply, RefusesBrokenHeaders) {
  EXPECT_THAT(refused("plx\n"), HasSubstr("bad.ply:1: this is no PLY file"));
  EXPECT_THAT(refused(ascii_xyz + "1" + float_xyz), HasSubstr("the header has no end_header"));
  EXPECT_THAT(refused("ply\nelement vertex 1" + float_xyz + "end_header\n1 2 3\n"), HasSubstr("no format line"));
  EXPECT_THAT(refused("ply\nformat binary 1.0\n"), HasSubstr("bad.ply:2: unknown format \"binary\""));
  EXPECT_THAT(refused("ply\nproperty float x\n"), HasSubstr("a property stands before any element"));
  EXPECT_THAT(refused(ascii_xyz + "1\nproperty flout x\n"), HasSubstr("bad.ply:4: unknown type \"flout\""));
  EXPECT_THAT(refused(ascii_xyz + "1\nproperty float x\nproperty float y\nend_header\n1 2\n"),
              HasSubstr("the points have no z"));
  EXPECT_THAT(refused(ascii_xyz + "1" + float_xyz + "property float x\nend_header\n1 2 3 4\n"),
              HasSubstr("x of vertex is there twice"));
  EXPECT_THAT(refused("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int v\nend_header\n1 1\n"),
              HasSubstr("no element vertex"));
  EXPECT_THAT(refused(ascii_xyz + "0" + float_xyz + "end_header\n"), HasSubstr("the scan holds no points"));
}

TEST(Ply, RefusesBrokenPointsWithTheirPlace) {
  const std::string two = ascii_xyz + "2" + float_xyz + "end_header\n1 2 3\n";
  EXPECT_THAT(refused(two + "4 five 6\n"), HasSubstr("bad.ply:9:3: a number is needed, found \"five\""));
  EXPECT_THAT(refused(two + "4 5,5 6\n"), HasSubstr("write a decimal point, not a comma"));
  EXPECT_THAT(refused(two + "4 5\n"), HasSubstr("bad.ply:9: the line holds fewer values"));
  EXPECT_THAT(refused(two + "4 5 6 7\n"), HasSubstr("bad.ply:9: the line holds other values"));
  EXPECT_THAT(refused(two + "        "), HasSubstr("the file ends before the last of the 2 rows of vertex"));
  EXPECT_THAT(refused(two + "4 5 6\n7 8 9\n"), HasSubstr("bad.ply:10: there are more rows"));
  EXPECT_THAT(refused(two + "4 nan 6\n"), AllOf(HasSubstr("bad.ply:9: a point is not finite (4, nan, 6)")));
  EXPECT_THAT(refused(two + "4 -inf 6\n"), HasSubstr("not finite"));
}

TEST(Ply, InvalidPointsCanBeDropped) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("a.ply", ascii_xyz + "3" + float_xyz + "end_header\n1 2 3\nnan 2 3\n1 inf 3\n");
  EXPECT_EQ(tests::read_one(file, {.drop_invalid = true}).cloud.size(), 1U);
  const auto none = folder.write("b.ply", ascii_xyz + "1" + float_xyz + "end_header\nnan 2 3\n");
  EXPECT_THAT(tests::refusal(none, {.drop_invalid = true}), HasSubstr("holds no points"));
}

}  // namespace
}  // namespace adit::io
