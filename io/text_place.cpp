#include "io/text_place.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;
constexpr std::size_t longest_line_bytes = std::size_t{1} << 20;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// "4,2", "-0,5": a decimal comma.
bool is_comma_decimal(std::string_view text) {
  const auto comma = text.find(',');
  return comma != std::string_view::npos && comma > 0 && is_digit(text[comma - 1]) && comma + 1 < text.size() &&
         is_digit(text[comma + 1]);
}

Field trimmed(std::string_view line, std::size_t begin, std::size_t end, int line_number) {
  while (begin < end && is_blank(line[begin])) ++begin;
  while (end > begin && is_blank(line[end - 1])) --end;
  if (end - begin >= 2 && line[begin] == '"' && line[end - 1] == '"') ++begin, --end;
  return {line.substr(begin, end - begin), line_number, static_cast<int>(begin) + 1};
}

}  // namespace

std::optional<double> number_in(std::string_view text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  double value = 0.0;
  const auto result = std::from_chars(begin, end, value);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

void split_at_blanks(std::string_view line, int line_number, std::vector<Field>& fields) {
  fields.clear();
  const char* const text = line.data();
  const std::size_t size = line.size();
  std::size_t i = 0;
  while (true) {
    while (i < size && is_blank(text[i])) ++i;
    if (i == size) return;
    const std::size_t begin = i;
    while (i < size && !is_blank(text[i])) ++i;
    fields.push_back({line.substr(begin, i - begin), line_number, static_cast<int>(begin) + 1});
  }
}

void split_at(char separator, std::string_view line, int line_number, std::vector<Field>& fields) {
  fields.clear();
  if (line.find_first_not_of(" \t") == std::string_view::npos) return;
  std::size_t begin = 0;
  bool in_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') in_quotes = !in_quotes;
    if (line[i] != separator || in_quotes) continue;
    fields.push_back(trimmed(line, begin, i, line_number));
    begin = i + 1;
  }
  fields.push_back(trimmed(line, begin, line.size(), line_number));
}

std::string quoted_word(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string word = "\"";
  for (const char c : text.substr(0, longest)) word += (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) ? '?' : c;
  return word + (text.size() > longest ? "...\"" : "\"");
}

LineReader::LineReader(const std::filesystem::path& path)
    : own_file_(std::make_unique<InputFile>(path)), file_(own_file_.get()), buffer_offset_(0), line_number_(0) {}

LineReader::LineReader(const InputFile& file, std::uint64_t offset, int first_line)
    : file_(&file), buffer_offset_(offset), line_number_(first_line - 1) {}

/// Drops what has been read and adds a block; false when the file has no more.
bool LineReader::fill() {
  buffer_offset_ += next_;
  buffer_.erase(0, next_);
  next_ = 0;
  const std::size_t kept = buffer_.size();
  const std::uint64_t from = buffer_offset_ + kept;
  const std::uint64_t left = from < file_->size() ? file_->size() - from : 0;
  buffer_.resize(kept + static_cast<std::size_t>(std::min<std::uint64_t>(block_bytes, left)));
  const std::size_t got = file_->read_some(from, buffer_.data() + kept, buffer_.size() - kept);
  buffer_.resize(kept + got);
  if (buffer_offset_ == 0 && kept == 0) {
    if (buffer_.starts_with("\xFF\xFE") || buffer_.starts_with("\xFE\xFF"))
      throw Error("the text is UTF-16", file_->name(), "save it as UTF-8");
    if (buffer_.starts_with("\xEF\xBB\xBF")) next_ = 3;
  }
  if (const std::size_t zero = buffer_.find('\0', kept); zero != std::string::npos)
    throw Error("a byte of zero; this is no text file", file_->at_byte(buffer_offset_ + zero),
                "check the file's ending and that it was copied whole");
  return got > 0;
}

bool LineReader::next() {
  line_ = {};
  std::size_t searched = 0;
  while (true) {
    const std::size_t end = buffer_.find('\n', next_ + searched);
    if (end != std::string::npos) {
      take_line(end - next_, end - next_ + 1);
      return true;
    }
    searched = buffer_.size() - next_;
    if (searched > longest_line_bytes) {
      ++line_number_;
      expect_no_carriage_return(std::string_view(buffer_).substr(next_));
      fail("the line is longer than 1 MiB", "is this a text file?");
    }
    if (!fill()) break;
  }
  if (next_ == buffer_.size()) return false;
  take_line(buffer_.size() - next_, buffer_.size() - next_);
  return true;
}

void LineReader::expect_no_carriage_return(std::string_view line) const {
  if (line.find('\r') != std::string_view::npos)
    fail("a carriage return inside the line", "save the file with line feeds at its line ends");
}

void LineReader::take_line(std::size_t length, std::size_t with_end) {
  line_ = std::string_view(buffer_).substr(next_, length);
  while (line_.ends_with('\r')) line_.remove_suffix(1);
  next_ += with_end;
  if (line_number_ == std::numeric_limits<int>::max()) fail("the file has too many lines", "split it");
  ++line_number_;
  expect_no_carriage_return(line_);
}

bool LineReader::next_with_text() {
  while (next())
    if (line_.find_first_not_of(" \t") != std::string_view::npos) return true;
  return false;
}

const std::vector<Field>& LineReader::fields(char separator) {
  if (std::count(line_.begin(), line_.end(), '"') % 2 != 0) fail("a double quote is not closed", "close or remove it");
  split_at(separator, line_, line_number_, fields_);
  return fields_;
}

const std::vector<Field>& LineReader::fields_between_blanks() {
  split_at_blanks(line_, line_number_, fields_);
  return fields_;
}

double LineReader::number_or_nan(const Field& field, std::string_view unit) const {
  const auto value = number_in(field.text);
  if (!value) not_a_number(field, unit);
  return *value;
}

double LineReader::number(const Field& field, std::string_view unit) const {
  const double value = number_or_nan(field, unit);
  if (!std::isfinite(value)) not_a_number(field, unit);
  return value;
}

std::uint64_t LineReader::count(const Field& field) const {
  std::uint64_t value = 0;
  const char* end = field.text.data() + field.text.size();
  const auto result = std::from_chars(field.text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end)
    fail(field, "a whole number is needed, found " + quoted_word(field.text), "write digits only");
  return value;
}

std::uint8_t LineReader::byte(const Field& field) const {
  const double value = number(field, "a colour");
  if (value < 0.0 || value > 255.0 || value != std::floor(value))
    fail(field, "a whole number from 0 to 255 is needed, found " + quoted_word(field.text), "write colours as bytes");
  return static_cast<std::uint8_t>(value);
}

void LineReader::not_a_number(const Field& field, std::string_view unit) const {
  if (field.text.empty()) fail(field, "a number is needed, found nothing", "fill the field in");
  const std::string what = "a number is needed, found " + quoted_word(field.text);
  if (is_comma_decimal(field.text)) fail(field, what, "write a decimal point, not a comma");
  fail(field, what, "write " + std::string(unit) + " with a decimal point");
}

std::string LineReader::place() const {
  return file_->name() + ":" + std::to_string(line_number_);
}

std::string LineReader::place(const Field& field) const {
  int column = field.column;
  // Columns were counted in bytes; people count letters, and a UTF-8 letter may be several bytes.
  if (field.line == line_number_ && static_cast<std::size_t>(column) <= line_.size() + 1)
    for (const char c : line_.substr(0, static_cast<std::size_t>(field.column - 1)))
      if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) --column;
  return file_->name() + ":" + std::to_string(field.line) + ":" + std::to_string(std::max(column, 1));
}

void LineReader::fail(const Field& field, const std::string& what_is_wrong, const std::string& mend) const {
  throw Error(what_is_wrong, place(field), mend);
}

void LineReader::fail(const std::string& what_is_wrong, const std::string& mend) const {
  throw Error(what_is_wrong, place(), mend);
}

}  // namespace adit::io
