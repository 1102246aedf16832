#include "io/text_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "core/foundation/error.h"
#include "tests/temporary_folder.h"

namespace adit::io {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

std::vector<std::string> texts(const std::vector<Field>& fields) {
  std::vector<std::string> result;
  for (const Field& field : fields) result.emplace_back(field.text);
  return result;
}

template <typename Call>
std::string words_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

TEST(TextPlace, LinesEndInAnyWay) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("a.csv", "\xEF\xBB\xBFone\r\ntwo\n\n  \nthree"));
  std::vector<std::string> read;
  while (lines.next()) read.emplace_back(lines.line());
  EXPECT_THAT(read, ElementsAre("one", "two", "", "  ", "three"));
  EXPECT_EQ(lines.line_number(), 5);
  EXPECT_FALSE(lines.next());
  LineReader with_text(folder / "a.csv");
  int count = 0;
  while (with_text.next_with_text()) ++count;
  EXPECT_EQ(count, 3);
  LineReader nothing(folder.write("b.csv", ""));
  EXPECT_FALSE(nothing.next());
}

TEST(TextPlace, LinesAcrossBlocksStayWhole) {
  const tests::TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 300'000; ++i) text += "line " + std::to_string(i) + "\r\n";
  LineReader lines(folder.write("a.txt", text));
  for (int i = 0; i < 300'000; ++i) {
    ASSERT_TRUE(lines.next());
    ASSERT_EQ(lines.line(), "line " + std::to_string(i));
  }
  EXPECT_FALSE(lines.next());
  EXPECT_EQ(lines.position(), text.size());
}

TEST(TextPlace, FieldsKnowTheirColumn) {
  std::vector<Field> fields;
  split_at_blanks("  1\t22  333 ", 7, fields);
  EXPECT_THAT(texts(fields), ElementsAre("1", "22", "333"));
  EXPECT_EQ(fields[2].column, 9);
  EXPECT_EQ(fields[2].line, 7);
  split_at(';', " a ; \"b;c\" ;;d", 1, fields);
  EXPECT_THAT(texts(fields), ElementsAre("a", "b;c", "", "d"));
  EXPECT_EQ(fields[1].column, 7);
  EXPECT_EQ(fields[3].column, 14);
  split_at(',', "  ", 1, fields);
  EXPECT_TRUE(fields.empty());
  split_at(',', "a,,", 1, fields);
  EXPECT_EQ(fields.size(), 3U);
}

double number_in(const std::string& word) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("n.csv", word + "\n"));
  lines.next();
  return lines.number(lines.fields(';').at(0));
}

TEST(TextPlace, NumbersOfEveryShape) {
  EXPECT_EQ(number_in("412"), 412.0);
  EXPECT_EQ(number_in("+4.5"), 4.5);
  EXPECT_EQ(number_in("-.5"), -0.5);
  EXPECT_EQ(number_in("6998765.1234"), 6998765.1234);
  EXPECT_EQ(number_in("1e-3"), 0.001);
  EXPECT_EQ(number_in("\"7.25\""), 7.25);
  for (const char* word : {"4l2.0", "4.2.0", "--4", "+-4", "0x10", "1 2", "1e999", "nan", "inf", "-", "+", "1e"})
    EXPECT_THAT(words_of([&] { number_in(word); }), HasSubstr("a number is needed, found \"")) << word;
}

TEST(TextPlace, MessagesNamePlaceWordAndMend) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("control.csv", "id,east,north\nP1,412.0,7\nP2,  4l2.0,7\nM\xC3\xBC,1,,\n5 4,2\n"));
  ASSERT_TRUE(lines.next() && lines.next() && lines.next());
  EXPECT_THAT(words_of([&] { lines.number(lines.fields(',').at(1)); }),
              EndsWith("control.csv:3:6: a number is needed, found \"4l2.0\"; write metres with a decimal point"));
  EXPECT_THAT(words_of([&] { lines.number(lines.fields(',').at(1), "degrees"); }),
              EndsWith("write degrees with a decimal point"));
  ASSERT_TRUE(lines.next());
  EXPECT_THAT(words_of([&] { lines.number(lines.fields(',').at(2)); }),
              EndsWith("control.csv:4:6: a number is needed, found nothing; fill the field in"));
  ASSERT_TRUE(lines.next());
  EXPECT_THAT(words_of([&] { lines.number(lines.fields_between_blanks().at(1)); }),
              EndsWith(":5:3: a number is needed, found \"4,2\"; write a decimal point, not a comma"));
  EXPECT_THAT(words_of([&] { lines.count(lines.fields_between_blanks().at(1)); }),
              HasSubstr("a whole number is needed"));
  EXPECT_THAT(words_of([&] { lines.fail("odd line", "mend it"); }), EndsWith("control.csv:5: odd line; mend it"));
}

TEST(TextPlace, NumbersThatScansMayHold) {
  const tests::TemporaryFolder folder;
  LineReader lines(folder.write("a.txt", "nan -inf 12 256 1.5 -1\n"));
  lines.next();
  const std::vector<Field>& fields = lines.fields_between_blanks();
  EXPECT_TRUE(std::isnan(lines.number_or_nan(fields[0])));
  EXPECT_TRUE(std::isinf(lines.number_or_nan(fields[1])));
  EXPECT_EQ(lines.byte(fields[2]), 12);
  for (const std::size_t i : {3U, 4U, 5U}) EXPECT_THROW(lines.byte(fields[i]), Error);
  EXPECT_EQ(lines.count(fields[3]), 256U);
  EXPECT_THROW(lines.count(fields[5]), Error);
}

TEST(TextPlace, RefusesWhatIsNoText) {
  const tests::TemporaryFolder folder;
  const auto first_line = [&](const std::string& bytes) {
    return words_of([&] { LineReader(folder.write("a.txt", bytes)).next(); });
  };
  EXPECT_THAT(first_line(std::string("\xFF\xFE"
                                     "1\0",
                                     4)),
              HasSubstr("UTF-16; save it as UTF-8"));
  EXPECT_THAT(first_line(std::string("12\0 3", 5)), HasSubstr("a.txt: byte 2: a byte of zero"));
  EXPECT_THAT(first_line(std::string(3'000'000, 'x')), HasSubstr("a.txt:1: the line is longer than 1 MiB"));
  LineReader open(folder.write("b.csv", "a,\"b\n"));
  open.next();
  EXPECT_THAT(words_of([&] { open.fields(','); }), HasSubstr("b.csv:1: a double quote is not closed"));
}

TEST(TextPlace, WordsInMessagesStayShortAndPrintable) {
  EXPECT_EQ(quoted_word("a\x01"
                        "b\n"),
            "\"a?b?\"");
  EXPECT_EQ(quoted_word(std::string(100, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

}  // namespace
}  // namespace adit::io
