#include "io/json_place.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "core/foundation/error.h"
#include "core/foundation/options.h"

namespace adit::io {
namespace {

std::string line_and_column(const std::string& text, std::size_t byte) {
  std::size_t line = 1, column = 1;
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    ++column;
    if (text[i] == '\n') {
      ++line;
      column = 1;
    }
  }
  return std::to_string(line) + ":" + std::to_string(column);
}

/// Says plainly what a text is that no JSON begins with, and what of it is no UTF-8.
void expect_json_text(const std::string& text, const std::string& file) {
  const auto begin = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (text.empty()) throw Error("the file is empty", file, "write it again");
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw Error("the text is UTF-16", file, "save it as UTF-8");
  if (begin == std::string::npos || (text[begin] != '{' && text[begin] != '[' && text[begin] != '/'))
    throw Error("this is not JSON: it does not begin with {", file + ":1:1",
                "name a job.json, or the folder that holds one");
}

[[noreturn]] void refuse_syntax(const std::string& text, std::size_t byte, const std::string& file) {
  const bool foreign = byte > 0 && byte <= text.size() && static_cast<unsigned char>(text[byte - 1]) >= 0x80U;
  const std::string place = file + ":" + line_and_column(text, byte);
  if (foreign) throw Error("a letter is not written in UTF-8", place, "save the file as UTF-8");
  throw Error("this is not JSON", place, "look for a missing comma, quote or bracket just before");
}

/// The parser's words end with the number in quotes.
[[noreturn]] void refuse_number(const std::string& text, const std::string& words, const std::string& file) {
  const auto end = words.rfind('\'');
  const auto begin = end == std::string::npos || end == 0 ? end : words.rfind('\'', end - 1);
  if (begin == std::string::npos || begin == end) throw Error("a number is too large", file, "check its unit");
  const std::string number = words.substr(begin + 1, end - begin - 1);
  const auto at = text.find(number);
  throw Error("the number " + number.substr(0, 40) + " is too large",
              at == std::string::npos ? file : file + ":" + line_and_column(text, at + 1), "check its unit");
}

/// The parser goes as deep as the text does, and the stack ends.
void expect_flat(const std::string& text, const std::string& file) {
  constexpr int deepest = 64;
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      i += c == '\\' ? 1 : 0;
      in_string = c != '"';
      continue;
    }
    in_string = c == '"';
    depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    if (depth > deepest)
      throw Error("brackets inside one another, more than 64 deep", file + ":" + line_and_column(text, i + 1),
                  "this is not a file Adit reads");
  }
}

/// Refuses an object with the same key twice: which one counts would be a guess.
struct DoubleKeys {
  std::vector<std::set<std::string>> open;
  std::string twice;
  bool operator()(int, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start) open.emplace_back();
    if (event == Event::object_end && !open.empty()) open.pop_back();
    if (event == Event::key && !open.empty() && !open.back().insert(value.get<std::string>()).second)
      twice = value.get<std::string>();
    return true;
  }
};

}  // namespace

nlohmann::json parse_json_file(const std::filesystem::path& file) {
  std::error_code missing;
  if (!std::filesystem::exists(file, missing)) throw Error("there is no such file", file.string(), "check the path");
  if (!std::filesystem::is_regular_file(file, missing))
    throw Error("this is not a regular file", file.string(), "name a file on a disk");
  if (std::filesystem::file_size(file) > (1U << 28))
    throw Error("the file is larger than 256 MiB", file.string(), "this is not a file Adit reads as JSON");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error("the file cannot be opened", file.string(), "check its permissions");
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  expect_json_text(text, file.string());
  expect_flat(text, file.string());
  DoubleKeys keys;
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text, std::ref(keys), true, true);
  } catch (const nlohmann::json::parse_error& error) {
    refuse_syntax(text, error.byte, file.string());
  } catch (const nlohmann::json::out_of_range& error) {
    refuse_number(text, error.what(), file.string());
  }
  if (!keys.twice.empty())
    throw Error("the key \"" + keys.twice + "\" stands twice in one object", file.string(), "remove one of them");
  return json;
}

std::string JsonPlace::found() const {
  std::string text = value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

void JsonPlace::refuse(const std::string& what_is_wrong, const std::string& mend) const {
  throw Error(what_is_wrong, key_.empty() ? file_ : file_ + ": " + key_, mend);
}

void JsonPlace::only_keys(const std::vector<std::string>& known) const {
  if (!value_->is_object()) refuse("an object { } is needed, found " + found(), "see docs/formats.md");
  for (const auto& [name, member] : value_->items()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const std::string& k : known) list += (list.empty() ? "" : ", ") + k;
    refuse("unknown key \"" + name + "\"", "known here: " + list);
  }
}

bool JsonPlace::has(const std::string& key) const {
  return value_->is_object() && value_->contains(key);
}

JsonPlace JsonPlace::at(const std::string& key) const {
  if (!value_->is_object()) refuse("an object { } is needed, found " + found(), "see docs/formats.md");
  const auto member = value_->find(key);
  if (member == value_->end()) refuse("the key \"" + key + "\" is missing", "add it; see docs/formats.md");
  return {*member, file_, key_.empty() ? key : key_ + "." + key};
}

std::vector<JsonPlace> JsonPlace::items() const {
  if (!value_->is_array()) refuse("a list [ ] is needed, found " + found(), "see docs/formats.md");
  std::vector<JsonPlace> places;
  for (std::size_t i = 0; i < value_->size(); ++i)
    places.emplace_back((*value_)[i], file_, key_ + "[" + std::to_string(i) + "]");
  return places;
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_->is_object()) refuse("an object { } is needed, found " + found(), "see docs/formats.md");
  std::vector<std::string> names;
  for (const auto& [name, member] : value_->items()) names.push_back(name);
  return names;
}

double JsonPlace::number() const {
  if (!value_->is_number())
    refuse("a number is needed, found " + found(), "write it without quotes, with a decimal point");
  const double number = value_->get<double>();
  if (!std::isfinite(number)) refuse("the number is too large", "check its unit");
  return number;
}

double JsonPlace::number_between(double least, double most, const std::string& unit) const {
  const double value = number();
  if (value < least || value > most)
    refuse("out of range, found " + found(), "a value from " + short_number(least) + " to " + short_number(most) +
                                                 (unit.empty() ? "" : " " + unit) + " is needed");
  return value;
}

std::int64_t JsonPlace::whole_number() const {
  if (!value_->is_number_integer()) refuse("a whole number is needed, found " + found(), "write it without quotes");
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() > (1ULL << 62))
    refuse("the number is too large", "check it");
  return value_->get<std::int64_t>();
}

std::string JsonPlace::text() const {
  if (!value_->is_string()) refuse("a text in quotes is needed, found " + found(), "put it in quotes");
  const auto& text = value_->get_ref<const std::string&>();
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20U || c == 0x7FU; }))
    refuse("a control character in " + found(), "take out line ends, tabs and the like");
  return text;
}

bool JsonPlace::yes_or_no() const {
  if (!value_->is_boolean()) refuse("true or false is needed, found " + found(), "write it without quotes");
  return value_->get<bool>();
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
  const auto places = items();
  if (places.size() != count)
    refuse(std::to_string(count) + " numbers are needed, found " + std::to_string(places.size()),
           "see docs/formats.md");
  std::vector<double> values;
  for (const auto& place : places) values.push_back(place.number());
  return values;
}

}  // namespace adit::io
