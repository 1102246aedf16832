#include "io/point_store.h"

#include <set>
#include <thread>

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string hash(64, 'a');

void store(const std::filesystem::path& path, const ScanData& scan) {
  Progress progress;
  write_point_store(path, scan, hash, progress);
}

std::string words_of_opening(const std::filesystem::path& path) {
  try {
    const PointStore opened(path);
    for (std::size_t t = 0; t < opened.tile_count(); ++t) opened.read(t);
  } catch (const Error& error) {
    return error.what();
  }
  return "(read)";
}

TEST(PointStore, GivesWhatTiledGives) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan_at_site(200'000);
  scan.file_pose = tests::sample_pose();
  scan.no_returns = 17;
  store(folder / "s.points", scan);
  const PointStore read(folder / "s.points");
  EXPECT_EQ(read.name(), "sample");
  EXPECT_EQ(read.offset(), scan.offset);
  ASSERT_TRUE(read.file_pose());
  EXPECT_EQ(read.file_pose()->matrix(), scan.file_pose->matrix());
  EXPECT_EQ(read.source_sha256(), hash);
  EXPECT_EQ(read.no_returns(), 17U);
  EXPECT_EQ(read.points(), 200'000U);
  const CloudTiles expected(scan.cloud);
  ASSERT_EQ(read.tile_count(), expected.tile_count());
  for (std::size_t t = 0; t < read.tile_count(); ++t) {
    EXPECT_EQ(read.point_count(t), expected.point_count(t));
    EXPECT_EQ(read.box(t).min(), expected.box(t).min());
    EXPECT_EQ(read.box(t).max(), expected.box(t).max());
    for (const std::size_t prefix : {std::size_t{0}, std::size_t{10}, std::size_t{5000}, all_points}) {
      const PointCloud a = read.read(t, prefix);
      const PointCloud b = expected.read(t, prefix);
      EXPECT_EQ(a.points, b.points);
      EXPECT_EQ(a.intensity, b.intensity);
      EXPECT_EQ(a.colour, b.colour);
      EXPECT_FALSE(a.has_normals());
    }
  }
}

TEST(PointStore, BareScanOfOnePoint) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{1, 2, 3}};
  Progress progress;
  write_point_store(folder / "s.points", scan, "", progress);
  const PointStore read(folder / "s.points");
  EXPECT_EQ(read.name(), "");
  EXPECT_EQ(read.source_sha256(), "");
  EXPECT_FALSE(read.file_pose());
  EXPECT_EQ(read.read(0).points, scan.cloud.points);
  EXPECT_FALSE(read.read(0).has_intensity() || read.read(0).has_colour());
  EXPECT_THROW(write_point_store(folder / "t.points", ScanData{}, "", progress), Error);
}

TEST(PointStore, SamePointsInAnyOrderGiveTheSameBytes) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(70'000);
  store(folder / "a.points", scan);
  std::vector<std::size_t> backwards(scan.cloud.size());
  for (std::size_t i = 0; i < backwards.size(); ++i) backwards[i] = backwards.size() - 1 - i;
  scan.cloud = selected(scan.cloud, backwards);
  store(folder / "b.points", scan);
  EXPECT_EQ(tests::bytes_of(folder / "a.points"), tests::bytes_of(folder / "b.points"));
}

TEST(PointStore, EveryCutIsRefused) {
  const tests::TemporaryFolder folder;
  store(folder / "s.points", tests::sample_scan(40));
  const std::string bytes = tests::bytes_of(folder / "s.points");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    ASSERT_THAT(words_of_opening(folder.write("cut.points", bytes.substr(0, length))),
                HasSubstr("damaged; run the import again"))
        << length;
  EXPECT_THAT(words_of_opening(folder.write("long.points", bytes + "x")), HasSubstr("damaged; run the import again"));
}

TEST(PointStore, EveryFlippedBitIsRefused) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(40);  // 40 points of 19 bytes fill whole words, so no byte is mere padding
  scan.file_pose = tests::sample_pose();
  scan.name = "namefour";
  store(folder / "s.points", scan);
  const std::string bytes = tests::bytes_of(folder / "s.points");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    ASSERT_THAT(words_of_opening(folder.write("bad.points", flipped)),
                AllOf(HasSubstr("bad.points"), HasSubstr("damaged; run the import again")))
        << i;
  }
}

TEST(PointStore, OverviewIsReadWithoutTheRestOfItsTile) {
  const tests::TemporaryFolder folder;
  store(folder / "s.points", tests::sample_scan(6'400));
  std::string bytes = tests::bytes_of(folder / "s.points");
  bytes[bytes.size() - 100] ^= 1;  // a colour at the end of the only tile
  const PointStore read(folder.write("bad.points", bytes));
  EXPECT_EQ(read.read(0, 100).size(), 100U);
  EXPECT_THROW(read.read(0, 101), Error);
  EXPECT_THROW(read.read(0), Error);
  EXPECT_EQ(read.read(0, 100).size(), 100U);
}

TEST(PointStore, ManyThreadsReadAtOnce) {
  const tests::TemporaryFolder folder;
  const ScanData scan = tests::sample_scan(300'000);
  store(folder / "s.points", scan);
  const PointStore read(folder / "s.points");
  std::atomic<std::size_t> points{0};
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (std::size_t t = 0; t < read.tile_count(); ++t) points += read.read(t, 500).size() + read.read(t).size();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(points.load(), 4 * (300'000 + 500 * read.tile_count()));
}

TEST(PointStore, OtherFilesAreRefused) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(words_of_opening(folder / "none.points"), HasSubstr("no such file"));
  EXPECT_THAT(words_of_opening(folder.path()), HasSubstr("this is a folder"));
  EXPECT_THAT(words_of_opening(folder.write("a.points", std::string(5000, 'x'))),
              HasSubstr("damaged; run the import again"));
}

TEST(PointStore, CancelledWritingLeavesNothing) {
  const tests::TemporaryFolder folder;
  const std::atomic<bool> cancelled{true};
  ProgressTarget target(nullptr, &cancelled);
  Progress progress(target);
  EXPECT_THROW(write_point_store(folder / "s.points", tests::sample_scan(100), hash, progress), Cancelled);
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

}  // namespace
}  // namespace adit::io
