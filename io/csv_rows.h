#pragma once
// Rows of a small table in text: comments, an optional header and the separator are found out.

#include <filesystem>
#include <string>
#include <vector>

#include "io/text_place.h"

namespace adit::io {

/// Walks through the rows that hold values. Lines that are empty or begin with # are passed over; a first line none of
/// whose fields begins like a number is the header. The separator is the first of tab, semicolon and comma that the
/// first line holds; blanks when it holds none and blanks are permitted.
class CsvRows {
 public:
  enum class Blanks { separate, belong_to_words };
  CsvRows(const std::filesystem::path& file, Blanks blanks, std::size_t words_before_numbers);

  /// Goes to the next row; false at the end.
  bool next();
  /// Fields of the present row, empty ones at its end left out.
  const std::vector<Field>& fields() const { return fields_; }
  /// Lower-case words of the header; empty without one.
  const std::vector<std::string>& header() const { return header_; }
  const LineReader& lines() const { return lines_; }
  double number(std::size_t i) const { return lines_.number(fields_.at(i)); }
  /// A number of metres no farther than any site. Throws Error with the place otherwise.
  double coordinate(std::size_t i) const;
  std::string text(std::size_t i) const { return std::string(fields_.at(i).text); }

  /// Throws Error with the place unless the row has `least` to `most` fields; `form` is the row as it should be.
  void expect_fields(std::size_t least, std::size_t most, const std::string& form) const;
  /// Throws Error when a word of the header names a unit other than the metre: "east_ft", "chainage [mm]", "km".
  void expect_metres() const;
  /// Throws Error when the header names another order: each of `letters` is what the word there may begin with.
  void expect_header(const std::vector<std::string>& letters, const std::string& form) const;

 private:
  bool next_line();
  void split();
  bool is_header() const;

  LineReader lines_;
  Blanks blanks_;
  std::size_t words_before_numbers_;
  char separator_ = 0;  ///< 0: not known yet
  bool first_ = true;
  int header_line_ = 0;
  std::vector<Field> fields_;
  std::vector<std::string> header_;
};

/// A word for a table written with commas: in double quotes when it needs them. Throws Error when it holds a double
/// quote or a line end, which the reader would not give back.
std::string csv_word(const std::string& word);

}  // namespace adit::io
