#pragma once
// Lines, fields and numbers of a text file, each with the place it stands at: file, line, column and the quoted word.
//
//   LineReader lines("control.csv");
//   while (lines.next()) {
//     const std::vector<Field>& fields = lines.fields(',');
//     const double east = lines.number(fields.at(1));
//   }

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.h"

namespace adit::io {

/// One word of a line. The text is valid until the reader's next line; line and column count from 1.
struct Field {
  std::string_view text;
  int line = 0;
  int column = 0;
};

/// Fields that stand between runs of blanks and tabs.
void split_at_blanks(std::string_view line, int line_number, std::vector<Field>& fields);

/// Fields that stand between separators, without the blanks around them and without one pair of double quotes; inside
/// quotes the separator is text (a doubled quote stays doubled). An empty line has no field, "a,," has three.
void split_at(char separator, std::string_view line, int line_number, std::vector<Field>& fields);

/// The number a word holds, "nan" and "inf" among them; empty when it holds none.
std::optional<double> number_in(std::string_view word);

/// The word in double quotes, cut to a readable length, other than printing bytes shown as "?".
std::string quoted_word(std::string_view text);

/// Reads a text file line by line: LF or CRLF, with or without a byte order mark, UTF-8 or Latin-1. Memory does not
/// grow with the file; a line of more than 1 MiB, a byte of zero or UTF-16 is an Error (it is no text).
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& path);
  /// Begins at `offset` of an open file, which must outlive the reader; the first line there is line `first_line`.
  explicit LineReader(const InputFile& file, std::uint64_t offset = 0, int first_line = 1);

  /// Goes to the next line; false at the end of the file.
  bool next();
  /// Goes to the next line that holds more than blanks; false at the end of the file.
  bool next_with_text();

  /// The present line without its end; valid until the next one.
  std::string_view line() const { return line_; }
  /// Its number, from 1; 0 before the first line.
  int line_number() const { return line_number_; }
  /// Offset in the file of the byte after the present line.
  std::uint64_t position() const { return buffer_offset_ + next_; }
  const InputFile& file() const { return *file_; }

  /// Fields of the present line, valid until the next call of fields() or next().
  const std::vector<Field>& fields(char separator);
  const std::vector<Field>& fields_between_blanks();

  /// The finite number a field holds, with a decimal point, whatever the locale. Error otherwise; its mend names what
  /// to write ("write metres with a decimal point").
  double number(const Field& field, std::string_view unit = "metres") const;
  /// As number(), but "nan" and "inf" pass: scans mark points without a return so.
  double number_or_nan(const Field& field, std::string_view unit = "metres") const;
  /// The whole number from 0 a field holds. Error otherwise.
  std::uint64_t count(const Field& field) const;
  /// The whole number 0 .. 255 a field holds (a colour). Error otherwise.
  std::uint8_t byte(const Field& field) const;

  /// "control.csv:7:12" and "control.csv:7".
  std::string place(const Field& field) const;
  std::string place() const;
  /// Throws Error{what_is_wrong, place, mend}.
  [[noreturn]] void fail(const Field& field, const std::string& what_is_wrong, const std::string& mend) const;
  [[noreturn]] void fail(const std::string& what_is_wrong, const std::string& mend) const;

 private:
  bool fill();
  void expect_no_carriage_return(std::string_view line) const;
  void take_line(std::size_t length, std::size_t with_end);
  [[noreturn]] void not_a_number(const Field& field, std::string_view unit) const;

  std::unique_ptr<InputFile> own_file_;
  const InputFile* file_;
  std::string buffer_;
  std::uint64_t buffer_offset_;
  std::size_t next_ = 0;
  std::string_view line_;
  int line_number_;
  std::vector<Field> fields_;
};

}  // namespace adit::io
