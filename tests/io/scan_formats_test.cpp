#include "io/scan_formats.h"

#include <atomic>

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ScanFormats, FirstBytesSayMoreThanTheName) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(50);
  for (const std::string ending : {".ply", ".pcd", ".las"}) {
    tests::write_one(folder / ("s" + ending), scan);
    std::filesystem::copy_file(folder / ("s" + ending), folder / ("s" + ending + ".dat"));
    std::filesystem::copy_file(folder / ("s" + ending), folder / ("s" + ending + ".txt"));
    EXPECT_TRUE(is_scan_file(folder / ("s" + ending + ".dat")));
    EXPECT_EQ(tests::read_one(folder / ("s" + ending + ".dat")).cloud.size(), 50U);
    EXPECT_EQ(tests::read_one(folder / ("s" + ending + ".txt")).cloud.size(), 50U);
  }
  EXPECT_TRUE(is_scan_file("anything.PTX"));
  EXPECT_FALSE(is_scan_file(folder.write("notes.md", "words")));
  EXPECT_FALSE(is_scan_file(folder.path()));
  EXPECT_FALSE(is_scan_file(folder / "none"));
}

TEST(ScanFormats, RefusesWhatIsNoScan) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(tests::refusal(folder / "none.ply"), HasSubstr("none.ply: no such file"));
  EXPECT_THAT(tests::refusal(folder.path()), HasSubstr("this is a folder"));
  EXPECT_THAT(tests::refusal(folder.write("a.json", "{}")),
              AllOf(HasSubstr("the ending names no scan format"), HasSubstr(".ply .pcd "),
                    HasSubstr(" .las .pts .ptx .xyz .csv .txt")));
  EXPECT_THAT(tests::refusal(folder.write("a.e57", "ASTM-E57")), HasSubstr("E57"));
  for (const std::string& ending : readable_endings())
    EXPECT_THAT(tests::refusal(folder.write("empty" + ending, "")), HasSubstr("the file is empty")) << ending;
}

TEST(ScanFormats, WritersRefuseWhatTheyCannotHold) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(5);
  Progress progress;
  EXPECT_THROW(write_scans(folder / "a.json", {scan}, {}, progress), Error);
  EXPECT_THROW(write_scans(folder / "a.ply", {}, {}, progress), Error);
  EXPECT_THROW(write_scans(folder / "a.ply", {scan, scan}, {}, progress), Error);
  EXPECT_THROW(write_scans(folder / "a.ply", {scan}, {"medium"}, progress), Error);
  EXPECT_THROW(write_scans(folder / "a.las", {scan}, {"binary"}, progress), Error);
  EXPECT_THROW(write_scans(folder / "a.ply", {ScanData{}}, {}, progress), Error);
  ScanData bad = scan;
  bad.cloud.points[2].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(write_scans(folder / "a.ply", {bad}, {}, progress), Error);
  bad = scan;
  bad.cloud.intensity.pop_back();
  EXPECT_THROW(write_scans(folder / "a.ply", {bad}, {}, progress), Error);
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

TEST(ScanFormats, OffsetIsWholeMetresAndSetOnlyWhereNeeded) {
  const tests::TemporaryFolder folder;
  const auto offset_of = [&](const std::string& text) { return tests::read_one(folder.write("a.xyz", text)).offset; };
  EXPECT_EQ(offset_of("1.23456 2 3\n"), Eigen::Vector3d::Zero());
  EXPECT_EQ(offset_of("9999.5 2 3\n"), Eigen::Vector3d::Zero());  // float32 holds 9999.5 exactly
  EXPECT_EQ(offset_of("9999.1235 2 3\n"), Eigen::Vector3d(9999, 2, 3));
  EXPECT_EQ(offset_of("10001 2 3\n"), Eigen::Vector3d(10001, 2, 3));
  EXPECT_EQ(offset_of("612345.6 6998765.4 412.1\n612355.6 6998755.4 414.1\n"), Eigen::Vector3d(612351, 6998760, 413));
}

TEST(ScanFormats, SummaryOfTextCountsWhatIsThere) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan_at_site(40);
  Progress progress;
  for (const std::string ending : {".pts", ".ptx", ".csv"}) {
    tests::write_one(folder / ("s" + ending), scan);
    const ScanFileSummary summary = summarise_scan_file(folder / ("s" + ending), progress);
    ASSERT_EQ(summary.scans.size(), 1U);
    EXPECT_EQ(summary.scans[0].points, 40U);
    EXPECT_TRUE(summary.scans[0].box.contains(scan.cloud.points[7].cast<double>() + scan.offset)) << ending;
  }
}

/// Counts the reports and asks to stop at one of them.
class Counting : public ProgressSink {
 public:
  explicit Counting(int stop_at) : stop_at_(stop_at) {}
  void report(double, const std::string&) override {
    if (++reports == stop_at_) cancelled = true;
  }
  int reports = 0;
  std::atomic<bool> cancelled{false};

 private:
  int stop_at_;
};

TEST(ScanFormats, ReadingAndWritingCanBeCancelledHalfWay) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(100'000);
  for (const std::string& ending : writable_endings()) {
    const auto path = folder / ("s" + ending);
    tests::write_one(path, scan);
    Counting counting(5);
    ProgressTarget target(&counting, &counting.cancelled);
    Progress progress(target);
    EXPECT_THROW(read_scans(path, {}, progress), Cancelled) << ending;
    EXPECT_EQ(counting.reports, 5) << ending;
    std::filesystem::remove(path);
    Counting again(5);
    ProgressTarget second(&again, &again.cancelled);
    Progress writing(second);
    EXPECT_THROW(write_scans(path, {scan}, {}, writing), Cancelled) << ending;
    EXPECT_EQ(tests::files_in(folder.path()), 0U) << ending;
  }
}

}  // namespace
}  // namespace adit::io
