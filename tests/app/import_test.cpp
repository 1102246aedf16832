// The import step by itself: which stores are taken up, which are made again, and what is refused every time.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>

#include "app/run_job.h"
#include "core/foundation/error.h"
#include "core/foundation/random.h"
#include "io/scan_formats.h"
#include "tests/temporary_folder.h"

namespace adit {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

io::ScanData scan_of(std::size_t points, double size_m) {
  const Random random(11);
  io::ScanData scan;
  for (std::uint64_t i = 0; i < points; ++i)
    scan.cloud.points.emplace_back(random.uniform(3 * i, -size_m, size_m), random.uniform(3 * i + 1, -size_m, size_m),
                                   random.uniform(3 * i + 2, -size_m, size_m));
  return scan;
}

class ImportOfAJob : public testing::Test {
 protected:
  void write_scans(const std::string& file, const std::vector<io::ScanData>& scans) const {
    Progress progress;
    io::write_scans(folder_ / file, scans, {}, progress);
  }
  /// entries: what stands in the list of scans.
  void write_job(const std::string& entries, const std::string& more = "") const {
    folder_.write("job.json", R"({"adit": 1, "name": "import", "scans": [)" + entries + "]" + more + "}");
  }
  std::shared_ptr<app::JobState> import() const {
    Progress progress;
    app::RunOptions options;
    options.last_step = "import";
    return app::run_job(folder_.path(), options, progress);
  }
  std::string words_of_import() const {
    try {
      import();
    } catch (const Error& error) {
      return error.what();
    }
    return "(imported)";
  }
  /// As a kill before the end of the step would leave it: whole stores, but no record of the step.
  void forget_the_step() const { fs::remove(folder_ / "out" / "steps" / "import.key"); }
  fs::file_time_type time_of_store(const std::string& name) const {
    return fs::last_write_time(folder_ / "out" / "import" / name);
  }

  tests::TemporaryFolder folder_;
};

TEST_F(ImportOfAJob, WholeStoresOfAnImportCutShortAreTakenUp) {
  write_scans("a.ply", {scan_of(2000, 10.0)});
  write_scans("b.ply", {scan_of(3000, 10.0)});
  write_job(R"({"name": "A", "file": "a.ply"}, {"name": "B", "file": "b.ply"})");
  import();
  const auto before = time_of_store("1-A.points");
  forget_the_step();
  fs::resize_file(folder_ / "out" / "import" / "2-B.points", 1000);
  const auto state = import();
  EXPECT_EQ(time_of_store("1-A.points"), before);
  EXPECT_EQ(state->stores[1]->points(), 3000U);
}

TEST_F(ImportOfAJob, AnotherContentNumberOrKeepingMakesAStoreAgain) {
  write_scans("a.ptx", {scan_of(2000, 10.0), scan_of(500, 10.0)});
  write_job(R"({"name": "A", "file": "a.ptx", "scan": 1})");
  EXPECT_EQ(import()->stores[0]->points(), 2000U);
  write_job(R"({"name": "A", "file": "a.ptx", "scan": 2})");
  EXPECT_EQ(import()->stores[0]->points(), 500U);
  write_job(R"({"name": "A", "file": "a.ptx", "scan": 2})", R"(, "options": {"import": {"keep": "float32"}})");
  EXPECT_EQ(import()->stores[0]->header().keep, io::Keep::float32);
}

TEST_F(ImportOfAJob, AStoreOfOneScanIsNotTakenForTheOnlyScanOfItsFile) {
  write_scans("a.ptx", {scan_of(2000, 10.0), scan_of(500, 10.0)});
  write_job(R"({"name": "A", "file": "a.ptx", "scan": 1})");
  import();
  write_job(R"({"name": "A", "file": "a.ptx"})");
  EXPECT_THAT(words_of_import(), HasSubstr("the file holds 2 scans (a, a-2)"));
}

TEST_F(ImportOfAJob, AWrongUnitIsRefusedEveryTime) {
  write_scans("a.ply", {scan_of(2000, 9000.0)});
  write_job(R"({"name": "A", "file": "a.ply"})");
  EXPECT_THAT(words_of_import(), HasSubstr("seems to be in millimetres"));
  EXPECT_THAT(words_of_import(), HasSubstr("seems to be in millimetres"));
}

/// Writes into a file as soon as it is being read.
class ChangesAFile : public ProgressSink {
 public:
  explicit ChangesAFile(fs::path file) : file_(std::move(file)) {}
  void report(double, const std::string& message) override {
    if (message.find("reading " + file_.filename().string()) == std::string::npos || done.exchange(true)) return;
    std::fstream file(file_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(2'000'000);
    file.put('x');
  }
  std::atomic<bool> done{false};

 private:
  fs::path file_;
};

TEST_F(ImportOfAJob, AFileThatChangesWhileItIsReadIsRefused) {
  write_scans("a.ply", {scan_of(300'000, 10.0)});
  write_job(R"({"name": "A", "file": "a.ply"})");
  ChangesAFile changes(folder_ / "a.ply");
  ProgressTarget target(&changes);
  Progress progress(target);
  app::RunOptions options;
  options.last_step = "import";
  try {
    app::run_job(folder_.path(), options, progress);
    FAIL() << "imported";
  } catch (const Error& error) {
    EXPECT_TRUE(changes.done);
    EXPECT_THAT(error.what(), HasSubstr("the file changed while it was being read"));
  }
  EXPECT_FALSE(fs::exists(folder_ / "out" / "import" / "1-A.points"));
}

TEST_F(ImportOfAJob, TheSameScanUnderTwoNamesIsSaid) {
  write_scans("a.ply", {scan_of(2000, 10.0)});
  write_job(R"({"name": "A", "file": "a.ply"}, {"name": "B", "file": "a.ply", "scan": 1})");
  const Findings findings = import()->results.import.findings;
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_THAT(findings[0].words, HasSubstr("the same scan of the same file as scan A"));
  fs::copy_file(folder_ / "a.ply", folder_ / "c.ply");
  write_job(R"({"name": "A", "file": "a.ply"}, {"name": "B", "file": "c.ply"}, {"name": "C", "file": "c.ply"})");
  const Findings copies = import()->results.import.findings;
  ASSERT_EQ(copies.size(), 2U);
  EXPECT_THAT(copies[0].words, HasSubstr("the same content as that of scan A"));
}

TEST_F(ImportOfAJob, TheFirstBadScanOfTheJobIsTheOneReported) {
  write_scans("good.ply", {scan_of(200'000, 10.0)});
  folder_.write("bad.xyz", "1 2 3\n1 2 x\n");
  folder_.write("worse.xyz", "x y z\n");
  for (int i = 0; i < 5; ++i) {
    write_job(
        R"({"name": "A", "file": "good.ply"}, {"name": "B", "file": "bad.xyz"}, {"name": "C", "file": "worse.xyz"})");
    EXPECT_THAT(words_of_import(), HasSubstr("bad.xyz:2"));
  }
}

}  // namespace
}  // namespace adit
