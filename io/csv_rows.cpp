#include "io/csv_rows.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "core/foundation/error.h"
#include "io/character_set.h"

namespace adit::io {
namespace {

bool begins_like_a_number(std::string_view word) {
  const std::size_t sign = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
  const std::size_t digit = sign < word.size() && (word[sign] == '.' || word[sign] == ',') ? sign + 1 : sign;
  return digit < word.size() && std::isdigit(static_cast<unsigned char>(word[digit])) != 0;
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& file, Blanks blanks, std::size_t words_before_numbers)
    : lines_(file), blanks_(blanks), words_before_numbers_(words_before_numbers) {}

bool CsvRows::next_line() {
  while (lines_.next_with_text()) {
    const std::string_view line = lines_.line();
    if (line[line.find_first_not_of(" \t")] != '#') return true;
  }
  return false;
}

void CsvRows::split() {
  if (separator_ == 0) {
    separator_ = blanks_ == Blanks::separate ? ' ' : ',';
    for (const char candidate : {',', ';', '\t'}) {
      if (lines_.line().find(candidate) != std::string_view::npos) separator_ = candidate;
    }
  }
  fields_ = separator_ == ' ' ? lines_.fields_between_blanks() : lines_.fields(separator_);
  while (!fields_.empty() && fields_.back().text.empty()) fields_.pop_back();
}

/// Ids may begin with a digit or a letter, so only fields that must be numbers tell a header from a row.
bool CsvRows::is_header() const {
  if (fields_.size() <= words_before_numbers_) return false;
  return std::none_of(fields_.begin() + static_cast<std::ptrdiff_t>(words_before_numbers_), fields_.end(),
                      [](const Field& field) { return begins_like_a_number(field.text); });
}

bool CsvRows::next() {
  if (!next_line()) return false;
  split();
  if (!first_) return true;
  first_ = false;
  if (!is_header()) return true;
  for (const Field& field : fields_) header_.push_back(lower_case(std::string(field.text)));
  header_line_ = lines_.line_number();
  if (!next_line()) return false;
  split();
  return true;
}

double CsvRows::coordinate(std::size_t i) const {
  constexpr double beyond_any_site_m = 1e8;  // as for poses in job.json
  const double value = number(i);
  if (std::abs(value) > beyond_any_site_m)
    lines_.fail(fields_.at(i), "a coordinate beyond 100,000 km", "metres are needed");
  return value;
}

void CsvRows::expect_fields(std::size_t least, std::size_t most, const std::string& form) const {
  if (fields_.size() >= least && fields_.size() <= most) return;
  lines_.fail("the row has " + std::to_string(fields_.size()) + " fields", "write " + form);
}

void CsvRows::expect_header(const std::vector<std::string>& letters, const std::string& form) const {
  if (header_.empty()) return;
  for (std::size_t i = 0; i < std::min(letters.size(), header_.size()); ++i) {
    if (header_[i].empty() || letters[i].find(header_[i][0]) != std::string::npos) continue;
    throw Error("column " + std::to_string(i + 1) + " is named " + quoted_word(header_[i]),
                lines_.file().name() + ":" + std::to_string(header_line_), "write the columns as " + form);
  }
}

void CsvRows::expect_metres() const {
  static const std::set<std::string> units{"ft", "feet", "foot", "in", "inch", "inches",
                                           "mm", "cm",   "km",   "yd", "usft"};
  for (const std::string& word : header_) {
    std::string token;
    for (const char c : word + " ") {
      if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
        token += c;
        continue;
      }
      if (units.count(token) > 0)
        throw Error("a column is named " + quoted_word(word), lines_.file().name() + ":" + std::to_string(header_line_),
                    "write metres");
      token.clear();
    }
  }
}

std::string csv_word(const std::string& word) {
  if (word.find_first_of("\"\r\n") != std::string::npos) {
    throw Error("the name " + quoted_word(word) + " holds a double quote or a line end", {}, "rename it");
  }
  if (!word.empty() && word.find_first_of(",;\t# ") == std::string::npos) return word;
  return "\"" + word + "\"";
}

}  // namespace adit::io
