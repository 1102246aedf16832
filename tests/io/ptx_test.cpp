#include "io/ptx.h"

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

const std::string unit_header = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::vector<ScanData> read_all(const std::filesystem::path& file) {
  Progress progress;
  return read_scans(file, {}, progress);
}

TEST(Ptx, RoundTripOfSeveralScans) {
  const tests::TemporaryFolder folder;
  std::vector<ScanData> scans = {tests::sample_scan(2'000), tests::sample_scan(500)};
  for (float& value : scans[0].cloud.intensity) value /= 65536.0F;
  scans[0].file_pose = tests::sample_pose();
  scans[0].file_pose->translation() += Eigen::Vector3d(612345.0, 6998765.0, 412.0);
  scans[1].cloud.intensity.clear();
  scans[1].cloud.colour.clear();
  Progress progress;
  write_scans(folder / "s.ptx", scans, {}, progress);
  const std::vector<ScanData> read = read_all(folder / "s.ptx");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].name, "s");
  EXPECT_EQ(read[0].cloud.points, scans[0].cloud.points);
  EXPECT_EQ(read[0].cloud.intensity, scans[0].cloud.intensity);
  EXPECT_EQ(read[0].cloud.colour, scans[0].cloud.colour);
  ASSERT_TRUE(read[0].file_pose);
  EXPECT_LT(distance_between_m(*read[0].file_pose, *scans[0].file_pose), 1e-9);
  EXPECT_LT(rotation_between_rad(*read[0].file_pose, *scans[0].file_pose), 1e-7);
  EXPECT_EQ(read[1].cloud.points, scans[1].cloud.points);
  EXPECT_FALSE(read[1].file_pose);
  EXPECT_EQ(read[1].cloud.intensity[0], 0.5F);
}

TEST(Ptx, IntensitiesOfAnotherScaleAreStretched) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  scan.cloud.intensity = {100.0F, 200.0F, 300.0F};
  tests::write_one(folder / "s.ptx", scan);
  EXPECT_THAT(tests::read_one(folder / "s.ptx").cloud.intensity, testing::ElementsAre(0.0F, 0.5F, 1.0F));
}

TEST(Ptx, TransformMovesRowsAndZerosAreNoReturns) {
  const tests::TemporaryFolder folder;
  // A quarter turn from x to y and a shift: site = point * matrix.
  const auto file = folder.write("a.ptx",
                                 "2\n2\n10 20 30\n0 1 0\n-1 0 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"
                                 "0 0 0 0.5\n1 2 3 0.25\n0 0 0 0.5\n4 5 6 1\n");
  const ScanData scan = tests::read_one(file);
  EXPECT_EQ(scan.cloud.size(), 2U);
  EXPECT_EQ(scan.no_returns, 2U);
  EXPECT_EQ(scan.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  const Eigen::Vector3d at_site = *scan.file_pose * scan.cloud.points[0].cast<double>();
  EXPECT_LT((at_site - Eigen::Vector3d(8, 21, 33)).norm(), 1e-9);
}

TEST(Ptx, LargeScannerCoordinatesGetAnOffset) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(500);
  tests::write_one(folder / "s.ptx", scan);
  EXPECT_LT(tests::largest_distance_m(tests::read_one(folder / "s.ptx"), scan), 1e-4);
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.ptx", bytes));
}

TEST(Ptx, RefusesTransformsThatAreNotRigid) {
  const std::string frame = "1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string tail = "0 0 0 1\n1 2 3 0.5\n";
  EXPECT_THAT(refused(frame + "1 0 0 0\n0 1 0 0\n0 0 2 0\n" + tail),
              HasSubstr("bad.ptx:10: the transform above is not rigid"));
  EXPECT_THAT(refused(frame + "1 0 0 0\n0 1 0 0\n0 0 -1 0\n" + tail), HasSubstr("not rigid"));
  EXPECT_THAT(refused(frame + "1 0.01 0 0\n0 1 0 0\n0 0 1 0\n" + tail), HasSubstr("not rigid"));
  EXPECT_THAT(refused(frame + "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n" + tail), HasSubstr("not rigid"));
  EXPECT_EQ(refused(frame + "1.0004 0 0 0\n0 1 0 0\n0 0 1 0\n" + tail), "(read)");
}

TEST(Ptx, RefusesWhatIsBroken) {
  EXPECT_THAT(refused("1000000000\n1000000000\n" + unit_header + "1 2 3 0.5\n"),
              HasSubstr("the header says 1000000000000000000 points, the file has room for 2 at most"));
  EXPECT_THAT(refused("99999999999\n1\n"), HasSubstr("a grid cannot have so many columns"));
  EXPECT_THAT(refused("1\n2\n" + unit_header + "1 2 3 0.5\n"),
              HasSubstr("the header says 2 points, the file ends after 1"));
  EXPECT_THAT(refused("1\n2\n0 0 0\n1 0 0\n"), HasSubstr("the file ends inside the header of a scan"));
  EXPECT_THAT(refused("1\n1\n" + unit_header + "1 2 3 0.5\n4 5 6 0.5\n"),
              HasSubstr("bad.ptx:12: the number of columns is needed alone"));
  EXPECT_THAT(refused("1\n2\n" + unit_header + "1 2 3 0.5\n4 5 6\n"),
              HasSubstr("bad.ptx:12: the line has 3 values, the first one 4"));
  EXPECT_THAT(refused("1\n1\n" + unit_header + "0 0 0 0.5\n"), HasSubstr("no points, only 1 places without a return"));
  EXPECT_THAT(refused("1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 nan 1\n1 2 3 0.5\n"),
              HasSubstr("bad.ptx:10:5: a number is needed"));
  EXPECT_THAT(refused("1\n1\n" + unit_header + "1 inf 3 0.5\n"), HasSubstr("bad.ptx:11: a point is not finite"));
  EXPECT_THAT(refused("0\n0\n" + unit_header), HasSubstr("holds no points"));
  EXPECT_THAT(refused("\n"), HasSubstr("the file holds no points"));
}

}  // namespace
}  // namespace adit::io
