// Whatever happens to a file, a reader gives the points that were in it or an Error: never other points, never a crash.

#include "tests/io/scan_samples.h"

namespace adit::io {
namespace {

struct Case {
  const char* file;
  const char* variant;
  bool knows_its_count;  ///< the file says how many points it has
};

std::ostream& operator<<(std::ostream& stream, const Case& c) {
  return stream << c.file << "_" << c.variant;
}

class DamagedScan : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    scan_ = tests::sample_scan(12);
    if (std::string_view(GetParam().file) != "s.xyz") scan_.file_pose = tests::sample_pose();
    tests::write_one(path_, scan_, GetParam().variant);
    bytes_ = tests::bytes_of(path_);
    whole_ = tests::read_one(path_);
    std::filesystem::remove(path_);
  }

  /// The scan that is read from other bytes; empty when they are refused. Anything but an Error fails the test.
  std::optional<ScanData> read(const std::string& bytes) {
    std::filesystem::remove(path_);  // some file systems flush a file that is cut and written again
    folder_.write(GetParam().file, bytes);
    Progress progress;
    try {
      return read_scans(path_, {}, progress).at(0);
    } catch (const Error& error) {
      EXPECT_THAT(error.where(), testing::HasSubstr(GetParam().file)) << error.what();
      return std::nullopt;
    }
  }

  tests::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / GetParam().file;
  ScanData scan_;
  ScanData whole_;
  std::string bytes_;
};

TEST_P(DamagedScan, CutAtEveryByteIsRefusedOrWhole) {
  std::size_t refused = 0;
  for (std::size_t length = 0; length < bytes_.size(); ++length) {
    const auto cut = read(bytes_.substr(0, length));
    if (!cut) {
      ++refused;
      continue;
    }
    if (GetParam().knows_its_count) {
      ASSERT_EQ(cut->cloud.size(), whole_.cloud.size()) << "cut at " << length;
    }
    ASSERT_LE(cut->cloud.size(), whole_.cloud.size());
    // A number at the end of a text may have lost digits; all points before it are the same.
    for (std::size_t i = 0; i + 1 < cut->cloud.size(); ++i) ASSERT_EQ(cut->cloud.points[i], whole_.cloud.points[i]);
  }
  EXPECT_GT(refused, bytes_.size() / 20);
}

TEST_P(DamagedScan, FlippedBitsInTheHeaderNeverChangeTheCount) {
  const std::size_t header = std::min<std::size_t>(bytes_.size(), 480);
  for (std::size_t i = 0; i < header; ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string flipped = bytes_;
      flipped[i] = static_cast<char>(static_cast<unsigned char>(flipped[i]) ^ (1U << bit));
      const auto scan = read(flipped);
      if (scan && GetParam().knows_its_count) {
        ASSERT_EQ(scan->cloud.size() + scan->no_returns, whole_.cloud.size()) << "byte " << i << " bit " << bit;
      }
    }
  }
}

TEST_P(DamagedScan, NoiseIsRefused) {
  const Random random(3);
  for (std::uint64_t round = 0; round < 200; ++round) {
    std::string noisy = bytes_;
    for (std::uint64_t k = 0; k < 20; ++k)
      noisy[random.bits(round * 64 + 2 * k) % noisy.size()] = static_cast<char>(random.bits(round * 64 + 2 * k + 1));
    read(noisy);  // fails the test on anything but an Error
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedScan,
                         testing::Values(Case{"s.ply", "ascii", true}, Case{"s.ply", "little", true},
                                         Case{"s.ply", "big", true}, Case{"s.pcd", "ascii", true},
                                         Case{"s.pcd", "binary", true}, Case{"s.pcd", "compressed", true},
                                         Case{"s.las", "", true}, Case{"s.pts", "", true}, Case{"s.ptx", "", true},
                                         Case{"s.xyz", "", false}),
                         [](const auto& parameter) {
                           std::string name = std::string(parameter.param.file).substr(2) + parameter.param.variant;
                           return name;
                         });

}  // namespace
}  // namespace adit::io
