#include "io/pts.h"

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

TEST(Pts, RoundTripKeepsEveryBit) {
  const tests::TemporaryFolder folder;
  for (const bool intensity : {false, true}) {
    for (const bool colour : {false, true}) {
      ScanData scan = tests::sample_scan(3'000);
      if (!intensity) scan.cloud.intensity.clear();
      if (!colour) scan.cloud.colour.clear();
      tests::write_one(folder / "s.pts", scan);
      const ScanData read = tests::read_one(folder / "s.pts");
      EXPECT_EQ(read.cloud.points, scan.cloud.points);
      EXPECT_EQ(read.cloud.intensity, scan.cloud.intensity);
      EXPECT_EQ(read.cloud.colour, scan.cloud.colour);
    }
  }
}

TEST(Pts, SiteCoordinatesKeepTenthOfMillimetre) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(3'000);
  tests::write_one(folder / "s.pts", scan);
  EXPECT_LT(tests::largest_distance_m(tests::read_one(folder / "s.pts"), scan), 1e-4);
}

TEST(Pts, EachCountBeginsAScan) {
  const tests::TemporaryFolder folder;
  Progress progress;
  const auto scans = read_scans(folder.write("two.pts", "1\n1 2 3\n\n2\r\n4 5 6 -7\r\n7 8 9 -8\r\n"), {}, progress);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[0].name, "two");
  EXPECT_EQ(scans[1].cloud.size(), 2U);
  EXPECT_EQ(scans[1].cloud.intensity[1], -8.0F);
}

std::string refused(const std::string& bytes) {
  const tests::TemporaryFolder folder;
  return tests::refusal(folder.write("bad.pts", bytes));
}

TEST(Pts, RefusesWhatIsBroken) {
  EXPECT_THAT(refused("1 2 3\n"), HasSubstr("bad.pts:1: the number of points is needed alone on a line"));
  EXPECT_THAT(refused("1000000000000\n1 2 3\n"),
              HasSubstr("the header says 1000000000000 points, the file has room for 1 at most"));
  EXPECT_THAT(refused("2\n1 2 3\n      "), HasSubstr("the header says 2 points, the file ends after 1"));
  EXPECT_THAT(refused("1\n1 2 3\n4 5 6\n"), HasSubstr("bad.pts:3: there are more points"));
  EXPECT_THAT(refused("-1\n1 2 3\n"), HasSubstr("a whole number is needed, found \"-1\""));
  EXPECT_THAT(refused("0\n"), HasSubstr("the scan holds no points"));
  EXPECT_THAT(refused("  \n\n"), HasSubstr("the file holds no points"));
  EXPECT_THAT(refused("2\n1 2 3\n1 2 3 4\n"), HasSubstr("bad.pts:3: the line has 4 values, the first one 3"));
  EXPECT_THAT(refused("1\n1 2 3 4 5\n"), HasSubstr("a point of 5 values"));
  EXPECT_THAT(refused("1\n1 2 3 4 5 6 256\n"), HasSubstr("bad.pts:2:13: a whole number from 0 to 255 is needed"));
  EXPECT_THAT(refused("1\n1 2 x\n"), HasSubstr("bad.pts:2:5: a number is needed, found \"x\""));
  EXPECT_THAT(refused("1\n1 2 nan\n"), HasSubstr("bad.pts:2: a point is not finite"));
}

}  // namespace
}  // namespace adit::io
