#include "io/e57.h"

#include <E57Format.h>

#include <atomic>
#include <functional>
#include <map>
#include <thread>

#include "tests/io/scan_streams.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::StreamedScan;

constexpr double half_step_m = 0.5e-4 * 1.7321 + 1e-9;  // half a tenth of a millimetre along each axis

std::vector<StreamedScan> round_trip(const std::vector<StreamedScan>& scans, const std::string& variant = {}) {
  const tests::TemporaryFolder folder;
  tests::write_streams(make_e57_writer, folder / "s.e57", scans, variant);
  EXPECT_EQ(tests::files_in(folder.path()), 1U);
  return tests::stream_all(folder / "s.e57");
}

TEST(E57, ManyThreadsReadAtOnce) {
  const tests::TemporaryFolder folder;
  const std::vector<StreamedScan> scans{tests::sample_stream(500, "S")};
  tests::write_streams(make_e57_writer, folder / "s.e57", scans, "");
  std::atomic<std::size_t> points{0};
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      for (int turn = 0; turn < 50; ++turn) points += tests::stream_all(folder / "s.e57").at(0).points.size();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(points.load(), 4U * 50U * 500U);
}

TEST(E57, RoundTripKeepsSeveralScansAndTheirPoses) {
  std::vector<StreamedScan> scans{tests::sample_stream(70'001, "first"), tests::sample_stream(300, "second & <third>"),
                                  tests::only(tests::sample_stream(20, ""), {})};
  scans[0].header.file_pose = tests::sample_pose();
  scans[1].header.file_pose = make_pose({612345.5, 6998765.25, -3.0}, {3.1, 1.5, -0.4});
  const std::vector<StreamedScan> read = round_trip(scans);
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(tests::largest_distance_m(read[i], scans[i]), half_step_m);
    EXPECT_EQ(read[i].points.intensity, scans[i].points.intensity);
    EXPECT_EQ(read[i].points.colour, scans[i].points.colour);
    EXPECT_EQ(read[i].points.normals, scans[i].points.normals);
    ASSERT_EQ(read[i].points.grid.size(), scans[i].points.grid.size());
    for (std::size_t k = 0; k < read[i].points.grid.size(); ++k) {
      EXPECT_EQ(read[i].points.grid[k].row, scans[i].points.grid[k].row);
      EXPECT_EQ(read[i].points.grid[k].column, scans[i].points.grid[k].column);
    }
    EXPECT_EQ(read[i].header.points, scans[i].points.size());
    ASSERT_EQ(read[i].header.file_pose.has_value(), scans[i].header.file_pose.has_value());
  }
  EXPECT_EQ(read[0].header.name, "first");
  EXPECT_EQ(read[1].header.name, "second & <third>");
  EXPECT_EQ(read[2].header.name, "s-3");
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_TRUE(read[i].header.file_pose->isApprox(*scans[i].header.file_pose, 1e-14));
}

TEST(E57, EveryAttributeMayBeMissing) {
  for (unsigned mask = 0; mask < 16; ++mask) {
    const Attributes wanted{(mask & 1U) != 0, (mask & 2U) != 0, (mask & 4U) != 0, (mask & 8U) != 0};
    const StreamedScan read = round_trip({tests::only(tests::sample_stream(50), wanted)}).at(0);
    EXPECT_EQ(attribute_names(read.header.attributes), attribute_names(wanted));
    EXPECT_EQ(read.points.size(), 50U);
  }
}

TEST(E57, DoubleKeepsEveryBit) {
  StreamedScan scan = tests::sample_stream(1'000);
  const Random random(1);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    scan.points.positions[i] += Eigen::Vector3d(612345.0, 6998765.0, random.uniform(i, 0, 1));
    scan.points.intensity[i] = static_cast<float>(random.uniform(5'000 + i, -2000, 2000));
  }
  const StreamedScan read = round_trip({scan}, "double").at(0);
  EXPECT_EQ(read.points.positions, scan.points.positions);
  EXPECT_EQ(read.points.intensity, scan.points.intensity);
  EXPECT_LT(tests::largest_distance_m(round_trip({scan}).at(0), scan), half_step_m);
}

TEST(E57, PointsFarApartAreKeptAsDoubles) {
  StreamedScan scan = tests::only(tests::sample_stream(3), {});
  scan.points.positions = {{0.0, 0.0, 0.0}, {450'000.000001, 1.0, 2.0}, {3.0, 4.0, 5.0}};
  EXPECT_EQ(round_trip({scan}).at(0).points.positions, scan.points.positions);
}

TEST(E57, OnePointAndPlanesAreRead) {
  StreamedScan scan = tests::only(tests::sample_stream(1), {true, true, false, true});
  EXPECT_LT(tests::largest_distance_m(round_trip({scan}).at(0), scan), half_step_m);
  scan = tests::only(tests::sample_stream(5'000), {true, false, false, false});
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    scan.points.positions[i].z() = 2.5;
    scan.points.intensity[i] = 7.0F;
  }
  const StreamedScan read = round_trip({scan}).at(0);
  EXPECT_LT(tests::largest_distance_m(read, scan), half_step_m);
  EXPECT_EQ(read.points.intensity, scan.points.intensity);
}

TEST(E57, SameBytesTwice) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"a.e57", "b.e57"})
    tests::write_streams(make_e57_writer, folder / name, {tests::sample_stream(500), tests::sample_stream(50)});
  EXPECT_EQ(tests::bytes_of(folder / "a.e57"), tests::bytes_of(folder / "b.e57"));
}

TEST(E57, WithoutCommitNothingIsLeft) {
  const tests::TemporaryFolder folder;
  FactsSink facts;
  tests::hand_out(tests::sample_stream(100), facts);
  {
    const auto writer = make_e57_writer(folder / "s.e57", facts.scans, {});
    ASSERT_TRUE(writer->begin(facts.scans[0].header));
  }
  {
    const auto writer = make_e57_writer(folder / "s.e57", facts.scans, {});
    tests::hand_out(tests::sample_stream(100), *writer);
  }
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

TEST(E57, ScansThatAreNotWantedArePassedOver) {
  const tests::TemporaryFolder folder;
  tests::write_streams(make_e57_writer, folder / "s.e57",
                       {tests::sample_stream(100, "a"), tests::sample_stream(200, "b"), tests::sample_stream(50, "c")});
  tests::Recorder recorder;
  recorder.unwanted = {0, 2};
  Progress progress;
  stream_e57(folder / "s.e57", {}, recorder, progress);
  ASSERT_EQ(recorder.scans.size(), 1U);
  EXPECT_EQ(recorder.scans[0].header.name, "b");
  EXPECT_EQ(recorder.scans[0].points.size(), 200U);
}

TEST(E57, SummaryComesFromTheXml) {
  const tests::TemporaryFolder folder;
  StreamedScan scan = tests::sample_stream(1'000, "station 7");
  scan.header.file_pose = tests::sample_pose();
  tests::write_streams(make_e57_writer, folder / "s.e57", {scan, tests::only(tests::sample_stream(5), {})});
  Progress progress;
  const ScanFileSummary summary = summarise_e57(folder / "s.e57", progress);
  EXPECT_EQ(summary.format, "E57 1.0");
  ASSERT_EQ(summary.scans.size(), 2U);
  EXPECT_EQ(summary.scans[0].name, "station 7");
  EXPECT_EQ(summary.scans[0].points, 1'000U);
  EXPECT_TRUE(summary.scans[0].pose->isApprox(tests::sample_pose(), 1e-14));
  EXPECT_THAT(summary.scans[0].attributes, ElementsAre("intensity", "colour", "normals", "grid"));
  BoundingBox box;
  for (const Eigen::Vector3d& p : scan.points.positions) box.extend(p);
  EXPECT_LT((summary.scans[0].box.min() - box.min()).cwiseAbs().maxCoeff(), 0.051e-3);  // as stored
  EXPECT_LT((summary.scans[0].box.max() - box.max()).cwiseAbs().maxCoeff(), 0.051e-3);
}

TEST(E57, CancelIsHeard) {
  const tests::TemporaryFolder folder;
  tests::write_streams(make_e57_writer, folder / "s.e57", {tests::sample_stream(1'000)});
  const std::atomic<bool> stop{true};
  ProgressTarget target(nullptr, &stop);
  Progress progress(target);
  tests::Recorder recorder;
  EXPECT_THROW(stream_e57(folder / "s.e57", {}, recorder, progress), Cancelled);
}

/// A field of a record, with its values.
struct Column {
  const char* name;
  e57::Node node;
  std::vector<double> values;
};

/// A file of one scan with these columns, as the library makes it.
std::filesystem::path made_by_library(const std::filesystem::path& path, e57::ImageFile& file,
                                      std::vector<Column> columns,
                                      const std::function<void(e57::StructureNode&)>& more) {
  e57::StructureNode scan(file);
  scan.set("guid", e57::StringNode(file, "a"));
  more(scan);
  e57::VectorNode scans(file, true);
  file.root().set("formatName", e57::StringNode(file, "ASTM E57 3D Imaging Data File"));
  file.root().set("data3D", scans);
  scans.append(scan);
  e57::StructureNode record(file);
  std::vector<e57::SourceDestBuffer> buffers;
  for (Column& column : columns) {
    record.set(column.name, column.node);
    buffers.emplace_back(file, column.name, column.values.data(), column.values.size(), true, true);
  }
  e57::CompressedVectorNode records(file, record, e57::VectorNode(file, true));
  scan.set("points", records);
  e57::CompressedVectorWriter writer = records.writer(buffers);
  writer.write(columns.front().values.size());
  writer.close();
  file.close();
  return path;
}

TEST(E57, SphericalCoordinatesAndPlacesWithoutReturn) {
  const tests::TemporaryFolder folder;
  e57::ImageFile file((folder / "s.e57").string(), "w");
  const double right_angle = std::acos(0.0);
  const e57::FloatNode number(file, 0.0, e57::E57_DOUBLE);
  const auto angle = [&] { return e57::FloatNode(file, 0.0, e57::E57_DOUBLE); };
  const auto path = made_by_library(
      folder / "s.e57", file,
      {{"sphericalRange", number, {10.0, 20.0, 30.0, 1e300, 40.0}},
       {"sphericalAzimuth", angle(), {0.0, right_angle, 0.0, 0.0, 1.0}},
       {"sphericalElevation", angle(), {0.0, 0.0, -right_angle, 0.0, right_angle / 3}},
       {"sphericalInvalidState", e57::IntegerNode(file, 0, 0, 2), {0, 0, 0, 1, 0}},
       {"intensity", e57::ScaledIntegerNode(file, 0, 0, 1023, 1.0 / 1023, 0.0), {0.0, 1.0, 0.5, 0.0, 1.0}}},
      [](e57::StructureNode&) {});
  const StreamedScan scan = tests::stream_all(path).at(0);
  EXPECT_EQ(scan.no_returns, 1U);
  ASSERT_EQ(scan.points.size(), 4U);
  const std::vector<Eigen::Vector3d>& p = scan.points.positions;
  EXPECT_LT((p[0] - Eigen::Vector3d(10, 0, 0)).norm(), 1e-12);
  EXPECT_LT((p[1] - Eigen::Vector3d(0, 20, 0)).norm(), 1e-12);
  EXPECT_LT((p[2] - Eigen::Vector3d(0, 0, -30)).norm(), 1e-12);
  EXPECT_NEAR(p[3].norm(), 40.0, 1e-12);
  EXPECT_NEAR(p[3].z(), 20.0, 1e-12);
  EXPECT_NEAR(scan.points.intensity[2], 0.5, 1e-3);
  EXPECT_EQ(scan.header.points, 5U);
}

TEST(E57, InvalidPointsAttributesAndLimits) {
  const tests::TemporaryFolder folder;
  e57::ImageFile file((folder / "s.e57").string(), "w");
  const auto single = [&] { return e57::FloatNode(file, 0.0, e57::E57_SINGLE); };
  const auto flag = [&](int most) { return e57::IntegerNode(file, 0, 0, most); };
  const auto sixteen_bits = [&] { return e57::IntegerNode(file, 0, 0, 65535); };
  const auto path =
      made_by_library(folder / "s.e57", file,
                      {{"cartesianX", single(), {1, 2, 3, 4}},
                       {"cartesianY", single(), {1, 2, 3, 4}},
                       {"cartesianZ", single(), {1, 2, 3, 4}},
                       {"cartesianInvalidState", flag(2), {0, 2, 1, 0}},
                       {"intensity", single(), {-1.5, 0, 0, 8}},
                       {"isIntensityInvalid", flag(1), {0, 0, 0, 1}},
                       {"colorRed", sixteen_bits(), {0, 1, 1, 4095}},
                       {"colorGreen", sixteen_bits(), {2048, 1, 1, 0}},
                       {"colorBlue", sixteen_bits(), {65535, 1, 1, 0}},
                       {"isColorInvalid", flag(1), {0, 0, 0, 1}},
                       {"timeStamp", single(), {1, 2, 3, 4}}},
                      [&](e57::StructureNode& scan) {
                        e57::StructureNode limits(file);
                        for (const char* colour : {"Red", "Green"}) {
                          limits.set("color" + std::string(colour) + "Minimum", e57::IntegerNode(file, 0));
                          limits.set("color" + std::string(colour) + "Maximum", e57::IntegerNode(file, 4095));
                        }
                        scan.set("colorLimits", limits);
                      });
  const StreamedScan scan = tests::stream_all(path).at(0);
  EXPECT_EQ(scan.no_returns, 2U);
  EXPECT_THAT(scan.points.positions, ElementsAre(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(4, 4, 4)));
  EXPECT_THAT(scan.points.intensity, ElementsAre(-1.5F, 0.0F));
  EXPECT_THAT(scan.points.colour,
              ElementsAre(std::array<std::uint8_t, 3>{0, 128, 255}, std::array<std::uint8_t, 3>{0, 0, 0}));
}

TEST(E57, NumbersThatAreNotFiniteAreNamed) {
  const tests::TemporaryFolder folder;
  e57::ImageFile file((folder / "s.e57").string(), "w");
  const auto single = [&] { return e57::FloatNode(file, 0.0, e57::E57_DOUBLE); };
  const double nan = std::nan("");
  const auto path = made_by_library(folder / "s.e57", file,
                                    {{"cartesianX", single(), {1, nan, 3}},
                                     {"cartesianY", single(), {1, nan, 3}},
                                     {"cartesianZ", single(), {1, nan, INFINITY}}},
                                    [](e57::StructureNode&) {});
  EXPECT_THAT(tests::refusal(path), HasSubstr("s.e57: scan 1: point 3: a point is not finite (3, 3, infinite)"));
  const StreamedScan scan = tests::stream_all(path, {.drop_invalid = true}).at(0);
  EXPECT_EQ(scan.points.size(), 1U);
  EXPECT_EQ(scan.no_returns, 1U);
}

TEST(E57Data, RealFiles) {
  ADIT_NEED_REAL_DATA();
  const auto folder = tests::real_data() / "formats/e57";
  const std::map<std::string, std::string> expected = {
      {"3rdParty/las2e57/ColourRepresentation.e57", "153 colour"},
      {"reference/bunnyDouble.e57", "30571"},
      {"reference/bunnyInt32.e57", "30571"},
      {"self/ColouredCubeDouble.e57", "7680 colour"},
      {"self/ColouredCubeFloat.e57", "7680 colour"},
      {"self/InvalidCVHeader.e57", "InvalidCVHeader.e57: scan 1: the scan holds no points"},
      {"self/PinholeImageWithDistortionParameters.e57", "the file holds no scans"},
      {"self/ZeroPoints.e57", "the scan holds no points"},
      {"self/ZeroPointsInvalid.e57", "the scan holds no points"},
      {"self/bad-crc.e57", "a checksum of the file is wrong"},
      {"self/empty.e57", "the file holds no scans"},
      {"self/test filename äöü.e57", "the file holds no scans"},
      {"self/测试点云.e57", "the file holds no scans"}};
  for (const auto& [name, words] : expected) {
    const std::string said = tests::refusal(folder / name);
    if (said != "(read)") {
      EXPECT_THAT(said, HasSubstr(words)) << name;
      continue;
    }
    const StreamedScan scan = tests::stream_all(folder / name).at(0);
    std::string found = std::to_string(scan.points.size());
    for (const std::string& attribute : attribute_names(scan.header.attributes)) found += " " + attribute;
    EXPECT_EQ(found, words) << name;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".e57") {
      EXPECT_TRUE(expected.contains(std::filesystem::relative(entry.path(), folder).string())) << entry.path();
    }
}

TEST(E57Data, TheSameBunnyInDoublesAndWholeNumbers) {
  ADIT_NEED_REAL_DATA();
  const auto folder = tests::real_data() / "formats/e57/reference";
  const StreamedScan doubles = tests::stream_all(folder / "bunnyDouble.e57").at(0);
  EXPECT_LT(tests::largest_distance_m(doubles, tests::stream_all(folder / "bunnyInt32.e57").at(0)), 2e-6);
  BoundingBox box;
  for (const Eigen::Vector3d& p : doubles.points.positions) box.extend(p);
  EXPECT_LT((box.max() - doubles.header.box.max()).norm(), 1e-6);
}

}  // namespace
}  // namespace adit::io
