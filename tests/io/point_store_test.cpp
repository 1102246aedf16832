#include "io/point_store.h"

#include <array>
#include <thread>

#include "io/store_writer.h"
#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string hash(64, 'a');

void store(const std::filesystem::path& path, const ScanData& scan, Keep keep = Keep::tenth_millimetre,
           std::size_t run_points = StoreOptions{}.run_points) {
  Progress progress;
  StoreOptions options;
  options.name = scan.name;
  options.source_sha256 = hash;
  options.keep = keep;
  options.run_points = run_points;
  write_point_store(path, scan, options, progress);
}

/// Intensities are the points' numbers, so that each is known again.
ScanData numbered_scan(std::size_t n) {
  ScanData scan = tests::sample_scan_at_site(n);
  for (std::size_t i = 0; i < n; ++i) scan.cloud.intensity[i] = static_cast<float>(i);
  return scan;
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

TEST(PointStore, SaysWhatItHolds) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan_at_site(200'000);
  scan.file_pose = tests::sample_pose();
  scan.no_returns = 17;
  store(folder / "s.points", scan);
  const PointStore read(folder / "s.points");
  EXPECT_EQ(read.name(), "sample");
  ASSERT_TRUE(read.file_pose());
  EXPECT_EQ(read.file_pose()->matrix(), scan.file_pose->matrix());
  EXPECT_EQ(read.source_sha256(), hash);
  EXPECT_EQ(read.no_returns(), 17U);
  EXPECT_EQ(read.points(), 200'000U);
  EXPECT_EQ(read.tile_count(), 4U);
  EXPECT_EQ(total_points(read), 200'000U);
}

class StoredAs : public testing::TestWithParam<Keep> {};

TEST_P(StoredAs, EveryPointComesBackWithItsAttributes) {
  const tests::TemporaryFolder folder;
  const ScanData scan = numbered_scan(200'000);
  store(folder / "s.points", scan, GetParam());
  const PointStore read(folder / "s.points");
  const double allowed = GetParam() == Keep::float32 ? 2e-6 : 0.5e-4 + 2e-6;  // float32 at 20 m rounds by 1e-6 m
  std::vector<bool> seen(scan.cloud.size());
  double largest = 0.0;
  for (std::size_t t = 0; t < read.tile_count(); ++t) {
    const PointCloud tile = read.read(t);
    EXPECT_EQ(tile.points, read.positions(t));
    for (std::size_t i = 0; i < tile.size(); ++i) {
      const auto number = static_cast<std::size_t>(tile.intensity[i]);
      ASSERT_FALSE(seen.at(number));
      seen[number] = true;
      const Eigen::Vector3d original = scan.cloud.points[number].cast<double>() + scan.offset;
      largest = std::max(largest, (tile.points[i].cast<double>() + read.offset() - original).cwiseAbs().maxCoeff());
      ASSERT_EQ(tile.colour[i], scan.cloud.colour[number]);
      ASSERT_TRUE(read.box(t).contains(tile.points[i].cast<double>()));
    }
  }
  EXPECT_LE(largest, allowed);
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](bool s) { return s; }));
}

TEST_P(StoredAs, APrefixIsTheBeginningOfItsTileAndEven) {
  const tests::TemporaryFolder folder;
  ScanData scan;  // a wall of 8 x 8 m
  const Random random(5);
  for (std::uint64_t i = 0; i < 60'000; ++i)
    scan.cloud.points.emplace_back(random.uniform(2 * i, -4, 4), 3.0F, random.uniform(2 * i + 1, -4, 4));
  store(folder / "s.points", scan, GetParam());
  const PointStore read(folder / "s.points");
  ASSERT_EQ(read.tile_count(), 1U);
  const auto all = read.positions(0);
  for (const std::size_t prefix : {std::size_t{1}, std::size_t{10}, std::size_t{937}, std::size_t{5000}})
    EXPECT_EQ(read.positions(0, prefix), std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(prefix)));
  std::array<int, 64> cells{};
  for (const auto& p : read.positions(0, 1024))
    ++cells.at(static_cast<std::size_t>(std::floor(p.x() + 4.0F)) * 8 +
               static_cast<std::size_t>(std::floor(p.z() + 4.0F)));
  EXPECT_GT(*std::min_element(cells.begin(), cells.end()), 8);  // 16 each on average
  EXPECT_LT(*std::max_element(cells.begin(), cells.end()), 26);
}

TEST_P(StoredAs, MemoryAndOrderChangeNoByte) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(400'000);
  for (std::size_t i = 0; i < 3'000; ++i) scan.cloud.points[7 * i] = scan.cloud.points[0];  // many in one place
  store(folder / "a.points", scan, GetParam());
  store(folder / "b.points", scan, GetParam(), 60'000);
  std::vector<std::size_t> backwards(scan.cloud.size());
  for (std::size_t i = 0; i < backwards.size(); ++i) backwards[i] = backwards.size() - 1 - i;
  scan.cloud = selected(scan.cloud, backwards);
  store(folder / "c.points", scan, GetParam(), 1'000);
  EXPECT_EQ(tests::bytes_of(folder / "a.points"), tests::bytes_of(folder / "b.points"));
  EXPECT_EQ(tests::bytes_of(folder / "a.points"), tests::bytes_of(folder / "c.points"));
  EXPECT_EQ(tests::files_in(folder.path()), 3U);
}

INSTANTIATE_TEST_SUITE_P(PointStore, StoredAs, testing::Values(Keep::tenth_millimetre, Keep::float32),
                         [](const auto& keep) { return keep.param == Keep::float32 ? "float32" : "tenth_millimetre"; });

TEST(PointStore, IntensitiesTakeTheWidthTheyNeed) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(1'000);
  scan.cloud.colour.clear();
  const auto size_with = [&](float value) {
    scan.cloud.intensity.assign(scan.cloud.size(), value);
    store(folder / "s.points", scan);
    EXPECT_EQ(PointStore(folder / "s.points").read(0).intensity, scan.cloud.intensity) << value;
    return std::filesystem::file_size(folder / "s.points");
  };
  const auto none = size_with(0.0F);
  EXPECT_EQ(size_with(255.0F), none + 1000);
  EXPECT_EQ(size_with(65535.0F), none + 2000);
  EXPECT_EQ(size_with(0.25F), none + 4000);
  EXPECT_EQ(size_with(-7.0F), none + 4000);
  EXPECT_EQ(size_with(70000.0F), none + 4000);
}

TEST(PointStore, PulsesWithoutAnEchoAreLeftOut) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(100'000);
  for (std::size_t i = 0; i < 1'000; ++i) scan.cloud.points[i] = 32.76F * scan.cloud.points[i].normalized();
  store(folder / "s.points", scan);
  EXPECT_EQ(PointStore(folder / "s.points").points(), 99'000U);
  EXPECT_EQ(PointStore(folder / "s.points").no_returns(), 1'000U);
}

TEST(PointStore, OneScanOfAFileIsChosen) {
  const tests::TemporaryFolder folder;
  Progress progress;
  std::vector<ScanData> scans = {tests::sample_scan(100), tests::sample_scan(60)};
  write_scans(folder / "two.ptx", scans, {}, progress);
  const auto points_of = [&](std::uint64_t number) {
    StoreOptions options;
    options.scan = number;
    StoreWriter writer(folder / "s.points", options);
    stream_scans(folder / "two.ptx", {}, writer, progress);
    writer.write(progress);
    writer.commit();
    return PointStore(folder / "s.points").points();
  };
  EXPECT_EQ(points_of(1), 100U);
  EXPECT_EQ(points_of(2), 60U);
  EXPECT_THROW(points_of(3), Error);
  EXPECT_THROW(points_of(0), Error);
}

TEST(PointStore, BareScanOfOnePoint) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{1, 2, 3}};
  Progress progress;
  write_point_store(folder / "s.points", scan, {}, progress);
  const PointStore read(folder / "s.points");
  EXPECT_EQ(read.name(), "");
  EXPECT_EQ(read.source_sha256(), "");
  EXPECT_FALSE(read.file_pose());
  EXPECT_EQ(read.read(0).points, scan.cloud.points);
  EXPECT_FALSE(read.read(0).has_intensity() || read.read(0).has_colour());
  EXPECT_THROW(write_point_store(folder / "t.points", ScanData{}, {}, progress), Error);
}

TEST(PointStore, AnotherVersionIsNamed) {
  const tests::TemporaryFolder folder;
  store(folder / "s.points", tests::sample_scan(40));
  std::string bytes = tests::bytes_of(folder / "s.points");
  bytes[8] = 1;
  EXPECT_THAT(words_of_opening(folder.write("old.points", bytes)),
              HasSubstr("written by another version of Adit; run the import again"));
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
  ScanData scan = tests::sample_scan(40);
  scan.file_pose = tests::sample_pose();
  scan.name = "namefour";
  store(folder / "s.points", scan);
  const std::string bytes = tests::bytes_of(folder / "s.points");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    ASSERT_THAT(words_of_opening(folder.write("bad.points", flipped)),
                AllOf(HasSubstr("bad.points"), HasSubstr("run the import again")))
        << i;
  }
}

TEST(PointStore, OverviewIsReadWithoutTheRestOfItsTile) {
  const tests::TemporaryFolder folder;
  store(folder / "s.points", tests::sample_scan(6'400));
  std::string bytes = tests::bytes_of(folder / "s.points");
  const PointStore whole(folder / "s.points");
  const TileCode& code = whole.header().tiles[0].code;
  bytes[16 + column_offset(code, 5) - 9] ^= 1;  // a colour at the end of the only tile
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
  EXPECT_THROW(write_point_store(folder / "s.points", tests::sample_scan(100), {}, progress), Cancelled);
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

}  // namespace
}  // namespace adit::io
