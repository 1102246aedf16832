#include "io/bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/foundation/error.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using testing::HasSubstr;

template <typename Call>
std::string words_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(Bytes, NumbersOfBothEndings) {
  const std::byte bytes[] = {std::byte{0x12}, std::byte{0x34}, std::byte{0x56}, std::byte{0x78},
                             std::byte{0},    std::byte{0},    std::byte{0},    std::byte{0x80}};
  EXPECT_EQ(little<std::uint16_t>(bytes), 0x3412);
  EXPECT_EQ(big<std::uint16_t>(bytes), 0x1234);
  EXPECT_EQ(little<std::uint32_t>(bytes), 0x78563412U);
  EXPECT_EQ(big<std::uint32_t>(bytes), 0x12345678U);
  EXPECT_EQ(little<std::int64_t>(bytes), std::int64_t{0x78563412} - 0x7FFFFFFFFFFFFFFF - 1);
  const std::byte one[] = {std::byte{0x3F}, std::byte{0x80}, std::byte{0}, std::byte{0}};
  EXPECT_EQ(big<float>(one), 1.0F);
}

TEST(Bytes, RefusesWhatIsNoFile) {
  const tests::TemporaryFolder folder;
  EXPECT_THAT(words_of([&] { InputFile(folder / "none.las"); }), HasSubstr("none.las: no such file"));
  EXPECT_THAT(words_of([&] { InputFile{folder.path()}; }), HasSubstr("this is a folder"));
  EXPECT_THAT(words_of([&] { InputFile("/dev/null"); }), HasSubstr("not a regular file"));
}

TEST(Bytes, ReadsWithinTheFileOnly) {
  const tests::TemporaryFolder folder;
  const InputFile file(folder.write("a.las", "0123456789"));
  EXPECT_EQ(file.size(), 10U);
  EXPECT_EQ(file.beginning(4), "0123");
  EXPECT_EQ(file.read(8, 2, "tail").size(), 2U);
  EXPECT_THAT(words_of([&] { file.read(8, 3, "the tail"); }),
              HasSubstr("a.las: byte 8: the file of 10 bytes ends inside the tail"));
  EXPECT_THAT(words_of([&] { file.read(~std::uint64_t{0}, 1, "x"); }), HasSubstr("ends inside x"));
  EXPECT_THAT(words_of([&] { file.read(0, ~std::size_t{0}, "x"); }), HasSubstr("ends inside x"));
}

TEST(Bytes, CountsAreComparedWithTheSize) {
  const tests::TemporaryFolder folder;
  const InputFile file(folder.write("a.las", "0123456789"));
  file.expect_records(4, 2, 3, "points");
  EXPECT_THAT(words_of([&] { file.expect_records(4, 3, 3, "points"); }),
              HasSubstr("a.las: byte 4: the header says 3 points, the file has room for 2 at most"));
  EXPECT_THAT(words_of([&] { file.expect_records(4, ~std::uint64_t{0}, 3, "points"); }), HasSubstr("room for 2"));
  EXPECT_THAT(words_of([&] { file.expect_records(400, 1, 3, "points"); }), HasSubstr("room for 0"));
}

TEST(Bytes, CursorWalksAcrossItsBlocks) {
  const tests::TemporaryFolder folder;
  std::string bytes(3'000'001, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
  const InputFile file(folder.write("a.ply", bytes));
  ByteCursor cursor(file, 1, file.size());
  std::size_t at = 1;
  for (; at + 1013 <= bytes.size(); at += 1013) {
    ASSERT_EQ(cursor.position(), at);
    ASSERT_EQ(std::memcmp(cursor.take(1013), bytes.data() + at, 1013), 0);
  }
  EXPECT_THAT(words_of([&] { cursor.take(1013); }), HasSubstr("1013 more bytes are needed, the file ends after"));
  ByteCursor skipping(file, 0, 100);
  skipping.skip(99);
  EXPECT_EQ(std::to_integer<int>(*skipping.take(1)), 99);
  EXPECT_THAT(words_of([&] { skipping.skip(1); }), HasSubstr("a.ply: byte 100"));
}

}  // namespace
}  // namespace adit::io
