#include "io/scan_writer.h"

#include <algorithm>

#include "tests/io/scan_samples.h"
#include "tests/io/scan_streams.h"

namespace adit::io {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string unit_header = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";

std::vector<ScanFacts> facts_of(const std::filesystem::path& file) {
  Progress progress;
  FactsSink facts;
  stream_scans(file, {}, facts, progress);
  return facts.scans;
}

ScanFacts facts_of_text(const std::string& xyz) {
  const tests::TemporaryFolder folder;
  return facts_of(folder.write("a.xyz", xyz)).at(0);
}

TEST(ScanWriter, FactsOfAScan) {
  const tests::TemporaryFolder folder;
  ScanData scan = tests::sample_scan(100'000);
  scan.file_pose = tests::sample_pose();
  tests::write_one(folder / "s.pcd", scan);
  const ScanFacts facts = facts_of(folder / "s.pcd").at(0);
  BoundingBox box, site_box;
  for (const auto& p : scan.cloud.points) {
    box.extend(p.cast<double>());
    site_box.extend(*scan.file_pose * p.cast<double>());
  }
  EXPECT_EQ(facts.points, 100'000U);
  EXPECT_EQ(facts.box.min(), box.min());
  EXPECT_LT((facts.site_box.max() - site_box.max()).norm(), 1e-9);
  EXPECT_TRUE(facts.coordinates_are_float32);
  EXPECT_TRUE(facts.whole_intensities);
  EXPECT_EQ(facts.greatest_intensity, *std::max_element(scan.cloud.intensity.begin(), scan.cloud.intensity.end()));
  EXPECT_EQ(facts.rows, 0U);
}

TEST(ScanWriter, FactsLookAtEveryDigit) {
  EXPECT_TRUE(facts_of_text("x y z\n1.5 2 3\n").coordinates_are_float32);
  EXPECT_FALSE(facts_of_text("x y z\n1.5 2 3\n1.5 2.1 3\n").coordinates_are_float32);
  const ScanFacts facts = facts_of_text("x y z intensity\n1 2 3 7\n1 2 3 -2.5\n");
  EXPECT_FALSE(facts.whole_intensities);
  EXPECT_EQ(facts.least_intensity, -2.5F);
  EXPECT_EQ(facts.greatest_intensity, 7.0F);
}

TEST(ScanWriter, RasterOfPtxComesBackAsItWas) {
  const tests::TemporaryFolder folder;
  const std::string scan = "3\n2\n" + unit_header;
  const std::string plain = scan + "0 0 0 0.5\n1 2 3 0.25\n0 0 0 0.5\n0 0 0 0.5\n1.5 2 3 0\n0 0 0 0.5\n" + scan +
                            "1 2 3 1\n4 5 6 1\n7 8 9 1\n1 1 1 1\n2 2 2 1\n3 3 3 1\n";
  tests::convert(folder.write("a.ptx", plain), folder / "b.ptx");
  EXPECT_EQ(tests::bytes_of(folder / "b.ptx"), plain);
  const std::string coloured = scan + "0 0 0 0.5 0 0 0\n1 2 3 0.25 1 2 3\n0 0 0 0.5 0 0 0\n1 1 1 1 1 1 1\n" +
                               "0 0 0 0.5 0 0 0\n0 0 0 0.5 0 0 0\n";
  tests::convert(folder.write("c.ptx", coloured), folder / "d.ptx");
  EXPECT_THAT(tests::bytes_of(folder / "d.ptx"), StartsWith("2\n2\n"));  // nothing tells of an empty last column
  EXPECT_EQ(facts_of(folder / "d.ptx").at(0).points, 2U);
}

PointBlock two_points(GridPlace first, GridPlace second) {
  PointBlock block;
  block.positions = {{1, 2, 3}, {4, 5, 6}};
  block.grid = {first, second};
  return block;
}

std::string ptx_of(GridPlace first, GridPlace second) {
  const tests::TemporaryFolder folder;
  ScanHeader header;
  header.attributes.grid = true;
  FactsSink facts;
  PointBlock block = two_points(first, second);
  facts.begin(header);
  facts.take(block);
  facts.end(0);
  const auto writer = make_scan_writer(folder / "a.ptx", facts.scans, {});
  writer->begin(header);
  writer->take(block);
  writer->end(0);
  writer->commit();
  return tests::bytes_of(folder / "a.ptx");
}

TEST(ScanWriter, PointsThatDoNotFollowTheirRasterBecomeOneColumn) {
  EXPECT_THAT(ptx_of({0, 0}, {1, 1}), StartsWith("2\n2\n"));
  EXPECT_THAT(ptx_of({1, 1}, {0, 0}), StartsWith("1\n2\n"));
  EXPECT_THAT(ptx_of({1, 1}, {1, 1}), StartsWith("1\n2\n"));
  EXPECT_THAT(ptx_of({0, 0}, {4'000'000'000, 4'000'000'000}), StartsWith("1\n2\n"));
  EXPECT_THAT(ptx_of({0, 0}, {4'294'967'295, 4'294'967'295}), StartsWith("1\n2\n"));
}

/// What the writer says to a second pass that brings another file.
std::string refusal_of_another(const std::string& before, const std::string& after) {
  const tests::TemporaryFolder folder;
  Progress progress;
  const auto file = folder.write("a.ptx", before);
  const auto writer = make_scan_writer(folder / "b.ptx", facts_of(file), {});
  folder.write("a.ptx", after);
  try {
    stream_scans(file, {}, *writer, progress);
    writer->commit();
  } catch (const Error& error) {
    EXPECT_FALSE(std::filesystem::exists(folder / "b.ptx"));
    return error.what();
  }
  return "(written)";
}

TEST(ScanWriter, RefusesAFileThatChangedInBetween) {
  const auto scan = [](const std::string& points, int rows) {
    return "1\n" + std::to_string(rows) + "\n" + unit_header + points;
  };
  const std::string two = scan("1 2 3 0.5\n4 5 6 0.5\n", 2);
  EXPECT_EQ(refusal_of_another(two, two), "(written)");
  const auto changed = HasSubstr("the file changed while it was being read");
  EXPECT_THAT(refusal_of_another(two, scan("1 2 3 0.5\n4 5 6 0.5\n1 2 3 0.5\n", 3)), changed);
  EXPECT_THAT(refusal_of_another(two, scan("1 2 3 0.5\n", 1)), changed);
  EXPECT_THAT(refusal_of_another(two, two + two), changed);
  EXPECT_THAT(refusal_of_another(two + two, two), changed);
  EXPECT_THAT(refusal_of_another(two, scan("1 2 3 0.5\n4 5 7 0.5\n", 2)), changed);
  EXPECT_THAT(refusal_of_another(two, scan("1 2 3 0.5 1 1 1\n4 5 6 0.5 1 1 1\n", 2)), changed);
  EXPECT_THAT(refusal_of_another(scan("1 2 3 1\n0 0 0 1\n4 5 6 1\n", 3), scan("1 2 3 1\n4 5 6 1\n0 0 0 1\n", 3)),
              testing::Eq("(written)"));  // the same points on other places
}

ScanFacts facts_of_points(std::uint64_t points) {
  ScanFacts facts;
  facts.points = points;
  facts.box.extend(Eigen::Vector3d(1, 2, 3));
  facts.site_box = facts.box;
  return facts;
}

std::string refusal_of(const std::string& file, const std::vector<ScanFacts>& facts, const WriteOptions& options) {
  const tests::TemporaryFolder folder;
  try {
    make_scan_writer(folder / file, facts, options);
  } catch (const Error& error) {
    EXPECT_FALSE(error.mend().empty());
    EXPECT_EQ(tests::files_in(folder.path()), 0U);
    return error.what();
  }
  return "(made)";
}

TEST(ScanWriter, TheBoxOfAHeaderHoldsThePointsAsTheyAreStored) {
  const tests::TemporaryFolder folder;
  ScanData scan;
  scan.cloud.points = {{-0.094689F, 1.00004F, 7.0F}, {0.2F, -3.00007F, 4918.12375F}};
  for (const std::string ending : {".las", ".laz", ".e57"}) {
    const auto endings = writable_endings();
    if (std::find(endings.begin(), endings.end(), ending) == endings.end()) continue;
    tests::write_one(folder / ("a" + ending), scan);
    const tests::StreamedScan read = tests::stream_all(folder / ("a" + ending)).at(0);
    BoundingBox box;
    for (const auto& p : read.points.positions) box.extend(p);
    EXPECT_LT((box.min() - read.header.box.min()).cwiseAbs().maxCoeff(), 1e-9) << ending;
    EXPECT_LT((box.max() - read.header.box.max()).cwiseAbs().maxCoeff(), 1e-9) << ending;
  }
}

TEST(ScanWriter, ScansOfAPtxShareTheScaleOfTheirIntensities) {
  const tests::TemporaryFolder folder;
  ScanData dark, bright;
  dark.cloud.points = bright.cloud.points = {{1, 2, 3}, {4, 5, 6}};
  dark.cloud.intensity = {0.0F, 1.0F};
  bright.cloud.intensity = {0.0F, 200.0F};
  Progress progress;
  write_scans(folder / "a.ptx", {dark, bright}, {}, progress);
  const auto scans = tests::stream_all(folder / "a.ptx");
  EXPECT_FLOAT_EQ(scans.at(0).points.intensity[1], 0.005F);
  EXPECT_FLOAT_EQ(scans.at(1).points.intensity[1], 1.0F);
}

TEST(ScanWriter, RefusesWhatAFormatCannotHold) {
  const std::uint64_t most = (std::uint64_t{256} << 20) / 12;
  EXPECT_EQ(refusal_of("a.pcd", {facts_of_points(most)}, {"compressed"}), "(made)");
  EXPECT_THAT(refusal_of("a.pcd", {facts_of_points(most + 1)}, {"compressed"}),
              HasSubstr("is not written; write the variant binary"));
  EXPECT_THAT(refusal_of("a.las", {facts_of_points(1), facts_of_points(1)}, {}),
              HasSubstr("the format holds one scan, not 2; write one of "));
  EXPECT_EQ(refusal_of("a.ptx", {facts_of_points(1), facts_of_points(1)}, {}), "(made)");
  ScanFacts far = facts_of_points(1);
  far.box.extend(Eigen::Vector3d(1e12, 0, 0));
  far.site_box = far.box;
  EXPECT_THAT(refusal_of("a.ply", {far}, {}), HasSubstr("is no site coordinate"));
}

TEST(ScanWriter, DoublesAreKeptToTheBit) {
  const tests::TemporaryFolder folder;
  const auto text = folder.write("a.xyz", "612345.12345 6998765.54321 412.00001\n612346 6998765 413\n");
  tests::convert(text, folder / "a.ply");
  tests::convert(folder / "a.ply", folder / "b.xyz");
  EXPECT_EQ(tests::bytes_of(folder / "b.xyz"),
            "x y z\n612345.12345 6998765.54321 412.00001\n612346.00000 6998765.00000 413.00000\n");
}

}  // namespace
}  // namespace adit::io
