// What is said of a file without reading it: header and sample. Files of more than 8 MiB are sampled.

#include <algorithm>

#include "core/foundation/angle.h"
#include "io/e57.h"
#include "io/laz.h"
#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

constexpr std::size_t many = 1'000'000;

/// Points strewn at random over a sphere of 5 m about the scanner, as many to each square metre.
ScanData sphere(std::size_t points) {
  const Random random(11);
  ScanData scan;
  for (std::size_t i = 0; i < points; ++i) {
    const double z = random.uniform(2 * i, -1, 1), angle = random.uniform(2 * i + 1, 0, 2 * pi);
    const double r = std::sqrt(1 - z * z);
    scan.cloud.points.emplace_back(
        Eigen::Vector3d(5 * r * std::cos(angle), 5 * r * std::sin(angle), 5 * z).cast<float>());
  }
  return scan;
}

double density_of_sphere(std::size_t points) {
  return static_cast<double>(points) / (4 * pi * 25);
}

TEST(ScanSummarySlow, SampleOfALargeFile) {
  const tests::TemporaryFolder folder;
  const ScanData scan = sphere(many);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.ply", "little"}, {"b.ply", "ascii"}, {"a.pcd", "binary"}, {"b.pcd", "ascii"}, {"a.las", ""},
      {"a.pts", ""},       {"a.ptx", ""},      {"a.xyz", ""},       {"a.csv", ""}};
  for (const auto& [name, variant] : files) {
    tests::write_one(folder / name, scan, variant);
    const ScanSummary summary = tests::summary(folder / name).scans.at(0);
    EXPECT_EQ(summary.points, many) << name;
    EXPECT_FALSE(summary.points_estimated) << name;
    EXPECT_EQ(summary.box_from, name == "a.las" ? "header" : "sample") << name;
    EXPECT_LT((summary.box.min() - Eigen::Vector3d(-5, -5, -5)).norm(), 0.02) << name;
    EXPECT_LT((summary.box.max() - Eigen::Vector3d(5, 5, 5)).norm(), 0.02) << name;
    EXPECT_GT(summary.sampled_points, 50'000U) << name;
    EXPECT_LT(summary.sampled_points, 500'000U) << name;
    ASSERT_TRUE(summary.density) << name;
    EXPECT_EQ(summary.density->distance_m, 5.0) << name;
    // The median of what 2000 places say is good to a twentieth, and random points have it a tenth off the mean.
    EXPECT_NEAR(summary.density->points_per_m2 / density_of_sphere(many), 1.0, 0.15) << name;
    EXPECT_NEAR(summary.density->spacing_m(), 1 / std::sqrt(density_of_sphere(many)), 0.002) << name;
    std::filesystem::remove(folder / name);
  }
}

TEST(ScanSummary, SmallFilesAreReadWhole) {
  const tests::TemporaryFolder folder;
  const ScanData scan = sphere(20'000);
  for (const std::string& ending : writable_endings()) {
    tests::write_one(folder / ("a" + ending), scan);
    const ScanSummary summary = tests::summary(folder / ("a" + ending)).scans.at(0);
    EXPECT_EQ(summary.points, 20'000U) << ending;
    EXPECT_EQ(summary.sampled_points, 20'000U) << ending;
    const bool says_box = ending == ".las" || ending == ".laz" || ending == ".e57";
    EXPECT_EQ(summary.box_from, says_box ? "header" : "all points") << ending;
    EXPECT_NEAR(summary.density.value().points_per_m2 / density_of_sphere(20'000), 1.0, 0.15) << ending;
  }
  EXPECT_FALSE(tests::summary(folder.write("few.xyz", "1 2 3\n4 5 6\n")).scans.at(0).density);
  std::string endless;
  for (int i = 0; i < 200; ++i) endless += std::to_string(i) + "e300 0 0\n";
  EXPECT_FALSE(tests::summary(folder.write("endless.xyz", endless)).scans.at(0).density);
}

TEST(ScanSummary, AwayFromTheScannerTheMedianIsSaid) {
  const tests::TemporaryFolder folder;
  ScanData scan = sphere(20'000);
  scan.offset = {612345.0, 6998765.0, 412.0};
  tests::write_one(folder / "a.ply", scan);
  const PointDensity density = tests::summary(folder / "a.ply").scans.at(0).density.value();
  EXPECT_FALSE(density.distance_m);
  EXPECT_NEAR(density.points_per_m2 / density_of_sphere(20'000), 1.0, 0.15);
}

TEST(ScanSummary, SampleDoesNotFallOntoTheSameRowsOfARaster) {
  // 2048 columns of 1000 points: even places would all fall onto the first rows.
  const tests::TemporaryFolder folder;
  ScanData scan;
  for (int column = 0; column < 2048; ++column)
    for (int row = 0; row < 1000; ++row)
      scan.cloud.points.emplace_back(static_cast<float>(column) * 0.01F, 3.0F, static_cast<float>(row) * 0.02F);
  tests::write_one(folder / "a.ply", scan);
  const ScanSummary summary = tests::summary(folder / "a.ply").scans.at(0);
  EXPECT_GT(summary.box.max().z(), 19.9);
  EXPECT_NEAR(summary.density.value().points_per_m2, 5000.0, 750.0);
}

TEST(ScanSummary, NeverReadsThroughALargeFile) {
  // Letters where numbers belong are met by a reader, and passed over by a look.
  const tests::TemporaryFolder folder;
  std::string text;
  while (text.size() < (std::size_t{70} << 20)) text += "1.000 2.000 3.000\n-1.000 5.000 0.500\n";
  const double lines = static_cast<double>(text.size()) / 18.5;
  text.insert(text.size() / 2, "\nthese are no numbers\n");
  const auto file = folder.write("a.xyz", text);
  const ScanSummary summary = tests::summary(file).scans.at(0);
  EXPECT_TRUE(summary.points_estimated);
  EXPECT_NEAR(static_cast<double>(summary.points), lines, 0.01 * lines);
  EXPECT_EQ(summary.box.min(), Eigen::Vector3d(-1, 2, 0.5));
  EXPECT_EQ(summary.box.max(), Eigen::Vector3d(1, 5, 3));
}

TEST(ScanSummary, FindsEveryScanOfALargePtxAndPts) {
  const tests::TemporaryFolder folder;
  const std::string pose = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n10 20 30 1\n";
  std::string ptx, pts;
  for (const int columns : {100, 3000, 1}) {
    ptx += std::to_string(columns) + "\n100\n" + pose;
    pts += std::to_string(columns * 100) + "\n";
    for (int i = 0; i < columns * 100; ++i) {
      const std::string x = std::to_string(i % 977 + columns);
      ptx += i % 3 == 0 ? "0 0 0 0.5\n" : x + ".25000 2.00000 3.00000 0.125000\n";
      pts += x + ".25000000 2.00000000 3.00000000 17\n" + (i % 1000 == 0 ? "\n  \n" : "");
    }
    ptx += "\n";
  }
  const ScanFileSummary scans = tests::summary(folder.write("a.ptx", ptx));
  ASSERT_EQ(scans.scans.size(), 3U);
  EXPECT_EQ(scans.scans[0].name, "a");
  EXPECT_EQ(scans.scans[1].name, "a-2");
  EXPECT_EQ(scans.scans[1].points, 300'000U);
  EXPECT_EQ(scans.scans[1].columns, 3000U);
  EXPECT_EQ(scans.scans[1].rows, 100U);
  EXPECT_EQ(scans.scans[1].pose.value().translation(), Eigen::Vector3d(10, 20, 30));
  EXPECT_GT(scans.scans[1].box.min().x(), 2999.0);  // no place without a return, no other scan
  EXPECT_EQ(scans.scans[1].box_from, "sample");
  EXPECT_EQ(scans.scans[2].points, 100U);
  const ScanFileSummary blocks = tests::summary(folder.write("a.pts", pts));
  ASSERT_EQ(blocks.scans.size(), 3U);
  EXPECT_EQ(blocks.scans[1].points, 300'000U);
  EXPECT_GT(blocks.scans[1].box.min().x(), 2999.0);
  const std::string cut = ptx.substr(0, ptx.size() - 2000);
  EXPECT_THROW(tests::summary(folder.write("b.ptx", cut)), Error);
}

TEST(ScanSummary, PlacesWithoutAReturnAreCountedInSmallFiles) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("a.ptx",
                                 "2\n2\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
                                 "0 0 0 0.5\n1 2 3 0.25\n0 0 0 0.5\n4 5 6 1\n");
  const ScanSummary summary = tests::summary(file).scans.at(0);
  EXPECT_EQ(summary.points, 4U);
  EXPECT_EQ(summary.no_returns, 2U);
  EXPECT_EQ(summary.sampled_points, 2U);
  EXPECT_EQ(summary.box.min(), Eigen::Vector3d(1, 2, 3));
}

TEST(ScanSummary, SaysNoBoxWhereALookCannotTell) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(600'000);
  tests::write_one(folder / "a.pcd", scan, "compressed");
  const ScanSummary summary = tests::summary(folder / "a.pcd").scans.at(0);
  EXPECT_EQ(summary.points, 600'000U);
  EXPECT_TRUE(summary.box.isEmpty());
  EXPECT_EQ(summary.box_from, "");
}

/// The density that is said of a file in which points cannot be jumped to.
std::optional<PointDensity> density_in(const std::string& name, const ScanData& scan) {
  const tests::TemporaryFolder folder;
  tests::write_one(folder / name, scan);
  const ScanSummary summary = tests::summary(folder / name).scans.at(0);
  EXPECT_TRUE(!summary.density || (summary.sampled_points > 150'000 && summary.sampled_points < 400'000)) << name;
  return summary.density;
}

TEST(ScanSummarySlow, BeginningOfAFileWhosePointsCannotBeJumpedTo) {
  std::vector<std::string> names;
  if (e57_is_built_in()) names.emplace_back("a.e57");
  if (laz_is_built_in()) names.emplace_back("a.laz");
  const std::size_t points = 3 * many;  // more than 8 MiB of LAZ
  const ScanData strewn = sphere(points);
  ScanData in_order = strewn;
  const auto azimuth = [](const Eigen::Vector3f& p) { return std::atan2(p.y(), p.x()); };
  std::sort(in_order.cloud.points.begin(), in_order.cloud.points.end(),
            [&](const auto& a, const auto& b) { return azimuth(a) < azimuth(b); });
  for (const std::string& name : names) {
    for (const ScanData& scan : {strewn, in_order}) {
      const auto density = density_in(name, scan);
      ASSERT_TRUE(density) << name;
      EXPECT_EQ(density->distance_m, 5.0) << name;
      EXPECT_NEAR(density->points_per_m2 / density_of_sphere(points), 1.0, 0.2) << name;
    }
  }
}

std::string fact(const ScanFileSummary& summary, const std::string& name) {
  for (const HeaderFact& one : summary.header)
    if (one.name == name) return one.text;
  return "(none)";
}

void append(std::string& bytes, std::initializer_list<std::uint16_t> numbers) {
  for (const std::uint16_t n : numbers) bytes.append(reinterpret_cast<const char*>(&n), 2);
}

TEST(ScanSummary, LasHeaderSaysWhoWhenAndWhere) {
  const tests::TemporaryFolder folder;
  tests::write_one(folder / "a.las", tests::sample_scan(10));
  std::string bytes = tests::bytes_of(folder / "a.las");
  std::string record("\0\0LASF_Projection\0", 18);
  append(record, {34735, 32});
  record.resize(54);
  append(record, {1, 1, 0, 3, 2048, 0, 1, 4326, 3072, 0, 1, 25832, 3076, 0, 1, 9003});
  const std::uint32_t records = 1, points = static_cast<std::uint32_t>(375 + record.size());
  std::memcpy(bytes.data() + 96, &points, 4);
  std::memcpy(bytes.data() + 100, &records, 4);
  bytes[90] = 60;  // day
  bytes[92] = static_cast<char>(2024 & 255);
  bytes[93] = static_cast<char>(2024 >> 8);
  bytes.insert(375, record);
  const ScanFileSummary summary = tests::summary(folder.write("b.las", bytes));
  EXPECT_EQ(fact(summary, "software"), "Adit");
  EXPECT_EQ(fact(summary, "creation_date"), "2024-02-29");
  EXPECT_EQ(fact(summary, "epsg"), "EPSG:25832");
  EXPECT_EQ(fact(summary, "unit"), "US survey foot");
  EXPECT_EQ(fact(summary, "scale"), "0.0001 0.0001 0.0001");
  bytes[375 + 20] = '\xFF';  // the record is longer than the room for it
  bytes[375 + 21] = '\xFF';
  EXPECT_EQ(fact(tests::summary(folder.write("c.las", bytes)), "epsg"), "(none)");
}

TEST(ScanSummary, AHeaderThatBeliesItsPointsIsNotBelieved) {
  const tests::TemporaryFolder folder;
  tests::write_one(folder / "a.las", sphere(1000));
  std::string bytes = tests::bytes_of(folder / "a.las");
  const double least_x = -1.0;
  std::memcpy(bytes.data() + 187, &least_x, 8);
  const ScanSummary summary = tests::summary(folder.write("b.las", bytes)).scans.at(0);
  EXPECT_EQ(summary.box_from, "all points");
  EXPECT_NEAR(summary.box.min().x(), -5.0, 0.1);
}

TEST(ScanSummary, PlyCommentsAreKept) {
  const tests::TemporaryFolder folder;
  const auto file = folder.write("a.ply",
                                 "ply\nformat ascii 1.0\ncomment  made by  hand\nelement vertex 1\nproperty float x\n"
                                 "property float y\nproperty float z\nend_header\n1 2 3\n");
  EXPECT_EQ(fact(tests::summary(file), "comment"), "made by  hand");
}

}  // namespace
}  // namespace adit::io
