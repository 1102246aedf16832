// Broken E57 files, by accident and on purpose: an Error, never a crash, a hang or memory that the file cannot fill.

#include "io/e57.h"
#include "tests/io/e57_pages.h"
#include "tests/io/scan_streams.h"
#include "tests/real_data.h"

namespace adit::io {
namespace {

using testing::HasSubstr;
using tests::with_words;

class BrokenE57 : public testing::Test {
 protected:
  void SetUp() override {
    tests::StreamedScan scan = tests::sample_stream(3'000, "station");
    scan.header.file_pose = tests::sample_pose();
    tests::write_streams(make_e57_writer, folder_ / "s.e57", {scan});
    bytes_ = tests::bytes_of(folder_ / "s.e57");
  }

  std::string refused(const std::string& bytes) {
    std::filesystem::remove(folder_ / "b.e57");
    return tests::refusal(folder_.write("b.e57", bytes));
  }

  tests::TemporaryFolder folder_;
  std::string bytes_;
};

TEST_F(BrokenE57, CheckingToolsAgreeWithTheLibrary) {
  EXPECT_EQ(tests::with_checksums(tests::without_checksums(bytes_)), bytes_);
  EXPECT_EQ(refused(tests::with_xml(bytes_, tests::xml_of(bytes_))), "(read)");
}

TEST_F(BrokenE57, CutAnywhereIsRefused) {
  for (std::size_t length = 0; length < bytes_.size(); length += length < 100 ? 1 : 509)
    EXPECT_NE(refused(bytes_.substr(0, length)), "(read)") << length;
  EXPECT_THAT(refused(bytes_.substr(0, bytes_.size() / 2)), HasSubstr("cut short"));
}

TEST_F(BrokenE57, EveryFlippedBitIsFound) {
  for (std::size_t at = 0; at < bytes_.size(); at += at < 100 ? 1 : 331) {
    std::string flipped = bytes_;
    flipped[at] = static_cast<char>(static_cast<unsigned char>(flipped[at]) ^ (1U << (at % 8)));
    EXPECT_NE(refused(flipped), "(read)") << at;
  }
}

/// Behind what is checked before the first point is read.
TEST_F(BrokenE57, DamageFarBehindIsNamedByItsPage) {
  const std::vector<tests::StreamedScan> scans{tests::sample_stream(600'000, "long"),
                                               tests::sample_stream(50, "short")};
  tests::write_streams(make_e57_writer, folder_ / "long.e57", scans);
  std::string bytes = tests::bytes_of(folder_ / "long.e57");
  ASSERT_GT(bytes.size(), 15'000'000U);
  const std::size_t page = bytes.size() * 3 / 4 / tests::e57_page * tests::e57_page;
  bytes[page + 77] = static_cast<char>(bytes[page + 77] ^ 4);
  EXPECT_THAT(refused(bytes), HasSubstr("b.e57: byte " + std::to_string(page) +
                                        ": a checksum of the file is wrong; the file is damaged"));
}

/// The XML tells where the points of a scan begin, and their section how long it is.
TEST_F(BrokenE57, SectionsThatAreNone) {
  const auto at = [&](const std::string& place) {
    return refused(with_words(bytes_, "fileOffset=\"48\"", "fileOffset=\"" + place + "\""));
  };
  EXPECT_EQ(at("48"), "(read)");
  EXPECT_EQ(refused(with_words(bytes_, "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">",
                               "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\"><!-- - -->")),
            "(read)");
  EXPECT_NE(at("18446744073709551615"), "(read)");
  EXPECT_NE(at("1022"), "(read)");
  EXPECT_NE(at("0"), "(read)");
  std::string content = tests::without_checksums(bytes_);
  tests::put_number(content, 48 + 8, std::uint64_t{1} << 40);
  EXPECT_THAT(refused(tests::with_checksums(content)),
              HasSubstr("the points' section cannot have 1099511627776 bytes"));
  content = tests::without_checksums(bytes_);
  tests::put_number(content, 48 + 8, bytes_.size() - 48);
  EXPECT_THAT(refused(tests::with_checksums(content)), HasSubstr("goes beyond the file's end"));
  content = tests::without_checksums(bytes_);
  content[48] = 3;
  EXPECT_THAT(refused(tests::with_checksums(content)), HasSubstr("byte 48: no section with points begins here"));
}

TEST_F(BrokenE57, NumbersOfRecordsThatTheFileCannotHold) {
  const auto records = [&](const std::string& count) {
    return refused(with_words(bytes_, "recordCount=\"3000\"", "recordCount=\"" + count + "\""));
  };
  EXPECT_THAT(records("4000000000000"), HasSubstr("the XML says 4000000000000 points; the file has room for"));
  EXPECT_THAT(records("9223372036854775807"), HasSubstr("the file has room for"));
  EXPECT_THAT(records("-5"), HasSubstr("the XML says -5 points"));
  EXPECT_THAT(records("0"), HasSubstr("the scan holds no points"));
  EXPECT_THAT(records("3100"), testing::Not("(read)"));
}

/// Fields that are always the same take no room: then the number of records says nothing, and must not be believed.
TEST_F(BrokenE57, RecordsWithoutContent) {
  std::string bytes = with_words(bytes_, "recordCount=\"3000\"", "recordCount=\"1000000000000\"");
  const std::string xml = tests::xml_of(bytes);
  const std::size_t begin = xml.find("<prototype");
  const std::size_t end = xml.find("</prototype>");
  ASSERT_NE(end, std::string::npos);
  const std::string constant = R"( type="ScaledInteger" minimum="5" maximum="5" scale="1">5</)";
  std::string prototype = "<prototype type=\"Structure\">";
  for (const std::string name : {"cartesianX", "cartesianY", "cartesianZ"})
    prototype += "<" + name + constant + name + ">";
  bytes = tests::with_xml(bytes, xml.substr(0, begin) + prototype + xml.substr(end));
  EXPECT_THAT(refused(bytes), HasSubstr("the XML says 1000000000000 points; the file has room for 65536"));
}

TEST_F(BrokenE57, PosesThatAreNone) {
  EXPECT_THAT(refused(with_words(bytes_, "<w type=\"Float\">", "<w type=\"Float\">5")),
              HasSubstr("no unit quaternion"));
  const std::string xml = tests::xml_of(bytes_);
  const std::size_t translation = xml.find("<translation");
  const std::size_t x = xml.find("<x type=\"Float\">", translation);
  std::string infinite = xml;
  infinite.insert(x + 16, "1e999 ");
  EXPECT_THAT(refused(tests::with_xml(bytes_, infinite)), HasSubstr("out of min/max bounds"));
}

TEST_F(BrokenE57, XmlThatReachesOutOrGrows) {
  EXPECT_THAT(refused(with_words(bytes_, "<e57Root", "<!DOCTYPE e [<!ENTITY a \"aaaa\">]><e57Root")),
              HasSubstr("a document type"));
  EXPECT_THAT(
      refused(with_words(bytes_, "<e57Root",
                         "<e57Root xmlns:x=\"http://www.w3.org/2001/XMLSchema-instance\" "
                         "x:schemaLocation=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0 http://localhost/a\"")),
      HasSubstr("a schema"));
  EXPECT_THAT(refused(with_words(bytes_, "encoding=\"UTF-8\"", "encoding=\"UTF-16\"")), HasSubstr("not UTF-8"));
  std::string deep;
  for (int i = 0; i < 300'000; ++i) deep += "<a type=\"Structure\">";
  EXPECT_THAT(refused(with_words(bytes_, "<data3D", deep + "<data3D")), HasSubstr("nested more than 64 deep"));
  std::string bracket_in_quotes, ends_in_an_instruction = "<?p >";
  for (int i = 0; i < 100; ++i) bracket_in_quotes += "<q type=\"Structure\" z=\"/>\">";
  for (int i = 0; i < 100; ++i) ends_in_an_instruction += "</a>";
  EXPECT_THAT(refused(with_words(bytes_, "<data3D", bracket_in_quotes + "<data3D")), HasSubstr("nested more than"));
  EXPECT_THAT(refused(with_words(bytes_, "<data3D", ends_in_an_instruction + "?>" + deep + "<data3D")),
              HasSubstr("nested more than"));
  EXPECT_THAT(refused(with_words(bytes_, "scale=\"", "scale=\"0\" s=\"")),
              HasSubstr("cartesianX is zero or no number"));
  EXPECT_THAT(refused(tests::with_xml(bytes_, "no XML at all")), HasSubstr("does not begin as XML"));
  EXPECT_NE(refused(tests::with_xml(bytes_, "<?xml version=\"1.0\"?>\n<e57Root type=\"Structure\">")), "(read)");
}

TEST_F(BrokenE57, HeadersThatLie) {
  const auto with_number = [&](std::size_t offset, std::uint64_t value) {
    std::string content = tests::without_checksums(bytes_);
    tests::put_number(content, offset, value);
    return refused(tests::with_checksums(content));
  };
  EXPECT_THAT(with_number(16, 5), HasSubstr("the header says 5 bytes"));
  EXPECT_THAT(with_number(24, ~std::uint64_t{0}), HasSubstr("cannot stand at byte"));
  EXPECT_THAT(with_number(32, std::uint64_t{1} << 60U), HasSubstr("cannot have 1152921504606846976 bytes"));
  EXPECT_THAT(with_number(40, 1 << 20), HasSubstr("pages of 1048576 bytes"));
}

/// Whatever stands in the binary part, with checksums that are right.
TEST_F(BrokenE57, NoiseUnderRightChecksums) {
  const std::string content = tests::without_checksums(bytes_);
  const std::size_t binary = tests::xml_begin(content);
  const Random random(4);
  for (std::uint64_t k = 0; k < 300; ++k) {
    std::string noisy = content;
    for (std::uint64_t j = 0; j < 4; ++j) {
      const std::size_t within = k % 3 == 0 ? 200 : binary;  // section and first packet, or anywhere
      const std::size_t at = 48 + random.bits(32 * k + 2 * j) % (within - 48);
      noisy[at] = static_cast<char>(random.bits(32 * k + 2 * j + 1));
    }
    refused(tests::with_checksums(noisy));  // fails the test on anything but an Error or points
  }
}

/// Whatever stands in the XML part.
TEST_F(BrokenE57, NoiseInTheXml) {
  const std::string xml = tests::xml_of(bytes_);
  const Random random(6);
  for (std::uint64_t k = 0; k < 300; ++k) {
    std::string noisy = xml;
    for (std::uint64_t j = 0; j <= k % 3; ++j) {
      const std::size_t at = random.bits(16 * k + 2 * j) % noisy.size();
      const std::uint64_t what = random.bits(16 * k + 2 * j + 1);
      if (what % 3 == 0) noisy[at] = static_cast<char>('0' + what / 3 % 10);
      if (what % 3 == 1) noisy[at] = static_cast<char>(what >> 8U);
      if (what % 3 == 2) noisy.erase(at, 1 + what / 3 % 40);
    }
    refused(tests::with_xml(bytes_, noisy));
  }
}

TEST(E57Data, RealFilesBrokenGiveAnErrorOrPoints) {
  ADIT_NEED_REAL_DATA();
  const tests::TemporaryFolder folder;
  const Random random(8);
  for (const char* name : {"3rdParty/las2e57/ColourRepresentation.e57", "self/ColouredCubeFloat.e57",
                           "self/ZeroPointsInvalid.e57", "self/PinholeImageWithDistortionParameters.e57"}) {
    const std::string content = tests::without_checksums(tests::bytes_of(tests::real_data() / "formats/e57" / name));
    for (std::uint64_t k = 0; k < 150; ++k) {
      std::string broken = content;
      for (std::uint64_t j = 0; j <= k % 4; ++j)
        broken[random.bits(16 * k + 2 * j) % broken.size()] = static_cast<char>(random.bits(16 * k + 2 * j + 1));
      std::filesystem::remove(folder / "b.e57");
      tests::refusal(folder.write("b.e57", tests::with_checksums(broken)));
    }
  }
}

}  // namespace
}  // namespace adit::io
