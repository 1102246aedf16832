#include "io/laz.h"

#include <cstring>
#include <map>

#include "io/bytes.h"
#include "tests/io/scan_streams.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

using testing::HasSubstr;
using tests::StreamedScan;

constexpr double half_step_m = 0.5e-4 * 1.7321 + 1e-9;  // half a tenth of a millimetre along each axis

std::filesystem::path written(const tests::TemporaryFolder& folder, const StreamedScan& scan) {
  tests::write_streams(make_laz_writer, folder / "s.laz", {scan});
  return folder / "s.laz";
}

TEST(Laz, RoundTrip) {
  const tests::TemporaryFolder folder;
  for (const bool colour : {false, true}) {
    const StreamedScan scan = tests::only(tests::sample_stream(123'457), {true, colour, false, false});
    const std::vector<StreamedScan> read = tests::stream_all(written(folder, scan));
    ASSERT_EQ(read.size(), 1U);
    EXPECT_LT(tests::largest_distance_m(read[0], scan), half_step_m);
    EXPECT_EQ(read[0].points.intensity, scan.points.intensity);
    EXPECT_EQ(read[0].points.colour, scan.points.colour);
    EXPECT_EQ(read[0].header.points, 123'457U);
    EXPECT_LT((read[0].header.box.max() - Eigen::Vector3d(20, 15, 10)).norm(), 0.01);
    EXPECT_EQ(tests::files_in(folder.path()), 1U);
  }
}

TEST(Laz, SiteCoordinatesKeepTenthOfMillimetre) {
  const tests::TemporaryFolder folder;
  StreamedScan scan = tests::only(tests::sample_stream(3'000), {});
  for (Eigen::Vector3d& p : scan.points.positions) p += Eigen::Vector3d(612345.0, 6998765.0, 412.0);
  EXPECT_LT(tests::largest_distance_m(tests::stream_all(written(folder, scan)).at(0), scan), half_step_m);
}

TEST(Laz, TheSamePointsAsLas) {
  const tests::TemporaryFolder folder;
  const StreamedScan scan = tests::only(tests::sample_stream(5'000), {true, true, false, false});
  tests::write_one(folder / "s.las", tests::sample_scan(5'000));
  const StreamedScan las = tests::stream_all(folder / "s.las").at(0);
  const StreamedScan laz = tests::stream_all(written(folder, scan)).at(0);
  EXPECT_EQ(las.points.positions, laz.points.positions);
  EXPECT_EQ(las.points.intensity, laz.points.intensity);
  EXPECT_EQ(las.points.colour, laz.points.colour);
}

TEST(Laz, SameBytesTwice) {
  const tests::TemporaryFolder folder;
  const StreamedScan scan = tests::sample_stream(1'000);
  const std::string once = tests::bytes_of(written(folder, scan));
  EXPECT_EQ(once, tests::bytes_of(written(folder, scan)));
}

TEST(Laz, WithoutCommitNothingIsLeft) {
  const tests::TemporaryFolder folder;
  const StreamedScan scan = tests::sample_stream(100);
  {
    FactsSink facts;
    tests::hand_out(scan, facts);
    const auto writer = make_laz_writer(folder / "s.laz", facts.scans, {});
    tests::hand_out(scan, *writer);
  }
  EXPECT_EQ(tests::files_in(folder.path()), 0U);
}

/// Bytes stay bytes, whether the first or the last point shows that colours fill 16 bits.
TEST(Laz, ColoursOf8BitsAreKept) {
  const tests::TemporaryFolder folder;
  StreamedScan scan = tests::only(tests::sample_stream(70'000), {true, true, false, false});
  for (auto& colour : scan.points.colour) colour = {0, 0, 0};
  scan.points.colour.back() = {1, 2, 3};
  EXPECT_EQ(tests::stream_all(written(folder, scan)).at(0).points.colour, scan.points.colour);
}

TEST(Laz, CancelIsHeard) {
  const tests::TemporaryFolder folder;
  written(folder, tests::sample_stream(1'000));
  const std::atomic<bool> stop{true};
  ProgressTarget target(nullptr, &stop);
  Progress progress(target);
  tests::Recorder recorder;
  EXPECT_THROW(stream_laz(folder / "s.laz", {}, recorder, progress), Cancelled);
}

/// A small file of two chunks with everything in it.
class BrokenLaz : public testing::Test {
 protected:
  void SetUp() override {
    const StreamedScan scan = tests::only(tests::sample_stream(50'400), {true, true, false, false});
    bytes_ = tests::bytes_of(written(folder_, scan));
    whole_ = tests::stream_all(folder_ / "s.laz").at(0);
  }

  /// What is read from other bytes; the words of the refusal otherwise.
  std::string refused(const std::string& bytes) {
    std::filesystem::remove(folder_ / "b.laz");
    return tests::refusal(folder_.write("b.laz", bytes));
  }
  template <typename T>
  std::string refused_with(std::size_t offset, T value) {
    std::string bytes = bytes_;
    std::memcpy(bytes.data() + offset, &value, sizeof(T));
    return refused(bytes);
  }
  template <typename T>
  T at(std::size_t offset) const {
    return little<T>(reinterpret_cast<const std::byte*>(bytes_.data()) + offset);
  }

  static constexpr std::size_t payload = 375 + 54;  // of LASzip's record, the only one
  tests::TemporaryFolder folder_;
  std::string bytes_;
  StreamedScan whole_;
};

TEST_F(BrokenLaz, CutAnywhereIsRefused) {
  for (std::size_t length = 0; length < bytes_.size(); length += length < 600 ? 37 : bytes_.size() / 20)
    EXPECT_NE(refused(bytes_.substr(0, length)), "(read)") << length;
  EXPECT_NE(refused(bytes_.substr(0, bytes_.size() / 2)).find("cut short"), std::string::npos);
}

TEST_F(BrokenLaz, ContradictionsAreNamed) {
  const auto points = at<std::uint32_t>(96);
  EXPECT_THAT(refused_with<std::uint64_t>(247, 50'399), HasSubstr("the chunks hold 50400"));
  EXPECT_THAT(refused_with<std::uint64_t>(247, ~std::uint64_t{0}), HasSubstr("the chunk table has 2"));
  EXPECT_THAT(refused_with<std::uint32_t>(100, 0), HasSubstr("the record of LASzip is missing"));
  EXPECT_THAT(refused_with<std::uint32_t>(100, 0xFFFFFFFF), HasSubstr("reaches into the points"));
  EXPECT_THAT(refused_with<std::uint16_t>(375 + 20, 0xFFFF), HasSubstr("reaches into the points"));
  EXPECT_THAT(refused_with<std::uint16_t>(payload, 2), HasSubstr("compression 2"));
  EXPECT_THAT(refused_with<std::uint16_t>(payload + 32, 1), HasSubstr("the number of items"));
  EXPECT_THAT(refused_with<std::uint16_t>(payload + 36, 31), HasSubstr("an item of the record of LASzip"));
  EXPECT_THAT(refused_with<std::uint16_t>(payload + 38, 9), HasSubstr("an item of the record of LASzip"));
  EXPECT_THAT(refused_with<std::uint32_t>(payload + 12, 7), HasSubstr("chunks, the chunk table has 2"));
  EXPECT_THAT(refused_with<std::uint8_t>(104, 7), HasSubstr("the file holds"));
  EXPECT_THAT(refused_with<std::uint16_t>(105, 37), HasSubstr("the record of LASzip does not fit"));
  EXPECT_THAT(refused_with<std::uint32_t>(96, 0xFFFFFFFF), HasSubstr("the file ends where the points begin"));
  EXPECT_THAT(refused_with<std::uint64_t>(points, 1U << 30U), HasSubstr("the chunk table stands at byte"));
  EXPECT_THAT(refused_with<std::uint64_t>(points, 12), HasSubstr("in front of the points"));
  EXPECT_THAT(refused_with<std::uint64_t>(points, points), HasSubstr("did not end well"));
  EXPECT_THAT(refused_with<std::uint64_t>(points, ~std::uint64_t{0}), HasSubstr("chunk table"));
  const auto table = at<std::uint64_t>(points);
  EXPECT_THAT(refused_with<std::uint32_t>(table + 4, 0xFFFFFFFF), HasSubstr("the chunk table is damaged"));
  EXPECT_THAT(refused_with<std::uint32_t>(points + 8 + 36, 40'000), HasSubstr("chunk 1 of 2 says it has 40000 points"));
  for (std::size_t layer = 0; layer < 10; ++layer)
    EXPECT_THAT(refused_with<std::uint32_t>(points + 8 + 40 + 4 * layer, 0xFFFFFFF0), HasSubstr("chunk")) << layer;
}

/// Whatever the chunk table says: each chunk tells its own size.
TEST_F(BrokenLaz, ChunksOfDifferingSizesNeedNoTable) {
  std::string bytes = bytes_;
  const std::uint32_t differing = 0xFFFFFFFF;
  std::memcpy(bytes.data() + payload + 12, &differing, sizeof differing);
  for (std::size_t k = at<std::uint64_t>(at<std::uint32_t>(96)) + 8; k < bytes.size(); ++k) bytes[k] = 'x';
  const StreamedScan scan = tests::stream_all(folder_.write("d.laz", bytes)).at(0);
  EXPECT_EQ(scan.points.positions, whole_.points.positions);
  EXPECT_EQ(scan.points.colour, whole_.points.colour);
}

TEST_F(BrokenLaz, FlippedBitsGiveAllPointsOrAnError) {
  const Random random(5);
  const auto flipped_at = [&](std::size_t byte, unsigned bit) {
    std::string bytes = bytes_;
    bytes[byte] = static_cast<char>(static_cast<unsigned char>(bytes[byte]) ^ (1U << bit));
    std::filesystem::remove(folder_ / "f.laz");
    const auto file = folder_.write("f.laz", bytes);
    try {
      std::size_t points = 0;
      for (const StreamedScan& scan : tests::stream_all(file)) points += scan.points.size();
      EXPECT_EQ(points, whole_.points.size()) << "byte " << byte << " bit " << bit;
    } catch (const Error& error) {
      EXPECT_THAT(error.where(), HasSubstr("f.laz"));
    }
  };
  const std::size_t points = at<std::uint32_t>(96);
  for (std::size_t k = 0; k < 40; ++k) flipped_at(random.bits(k) % (points + 100), random.bits(1000 + k) & 7U);
  for (std::size_t k = 0; k < 10; ++k) flipped_at(random.bits(2000 + k) % bytes_.size(), random.bits(3000 + k) & 7U);
  for (std::size_t byte = at<std::uint64_t>(points); byte < bytes_.size(); byte += 2) flipped_at(byte, byte & 7U);
}

TEST(LazData, RealFiles) {
  ADIT_NEED_REAL_DATA();
  const auto folder = tests::real_data() / "formats/laz";
  const std::map<std::string, std::size_t> points = {{"1.2-with-color.copc.laz", 1065},
                                                     {"autzen_trim.laz", 110000},
                                                     {"laszip-generated.laz", 1065},
                                                     {"laszip-generated_with2bytespadding.laz", 1065},
                                                     {"liblas-generated.laz", 1065},
                                                     {"lone-star.laz", 518862},
                                                     {"simple-laszip-compressor-version-1.2r0.laz", 1065},
                                                     {"simple.laz", 1065},
                                                     {"split-1.laz", 122893}};
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".laz") continue;
    ASSERT_TRUE(points.contains(name)) << name;
    const StreamedScan scan = tests::stream_all(entry.path()).at(0);
    EXPECT_EQ(scan.points.size(), points.at(name)) << name;
    BoundingBox box;
    for (const Eigen::Vector3d& p : scan.points.positions) box.extend(p);
    EXPECT_LT((box.min() - scan.header.box.min()).norm() + (box.max() - scan.header.box.max()).norm(), 0.02) << name;
  }
}

TEST(LazData, TheSameSurveyInLasAndLaz) {
  ADIT_NEED_REAL_DATA();
  const auto folder = tests::real_data() / "formats";
  const StreamedScan las = tests::stream_all(folder / "las/autzen_trim.las").at(0);
  const StreamedScan laz = tests::stream_all(folder / "laz/autzen_trim.laz").at(0);
  EXPECT_EQ(las.points.positions, laz.points.positions);
  EXPECT_EQ(las.points.intensity, laz.points.intensity);
  EXPECT_EQ(las.points.colour, laz.points.colour);
}

TEST(LazData, RealFilesBrokenGiveAnErrorOrPoints) {
  ADIT_NEED_REAL_DATA();
  const tests::TemporaryFolder folder;
  const Random random(9);
  for (const char* name : {"1.2-with-color.copc.laz", "simple.laz", "laszip-generated_with2bytespadding.laz",
                           "simple-laszip-compressor-version-1.2r0.laz"}) {
    const std::string bytes = tests::bytes_of(tests::real_data() / "formats/laz" / name);
    for (std::uint64_t k = 0; k < 400; ++k) {
      std::string broken = bytes;
      for (std::uint64_t j = 0; j <= k % 4; ++j) {
        const std::size_t at = random.bits(16 * k + 2 * j) % (k % 2 == 0 ? broken.size() : std::size_t{900});
        broken[at] = static_cast<char>(random.bits(16 * k + 2 * j + 1));
      }
      if (k % 8 == 7) broken.resize(random.bits(16 * k + 9) % broken.size());
      std::filesystem::remove(folder / "b.laz");
      try {
        tests::stream_all(folder.write("b.laz", broken));
      } catch (const Error& error) {
        EXPECT_THAT(error.where(), HasSubstr("b.laz"));
      }
    }
  }
}

}  // namespace
}  // namespace adit::io
