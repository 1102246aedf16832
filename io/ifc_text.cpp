#include "io/ifc_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "io/character_set.h"
#include "io/text_file.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr int deepest_list = 32;

bool is_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Walks through the text; every step forward counts lines.
class Scanner {
 public:
  Scanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool at_end() {
    skip_blanks();
    return at_ >= text_.size();
  }
  char peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(std::string("\"") + c + "\" is missing");
  }
  std::string word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '-')) ++at_;
    std::string letters(text_.substr(begin, at_ - begin));
    for (char& c : letters) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return letters;
  }
  std::uint64_t instance_number() {
    expect('#');
    std::uint64_t number = 0;
    const auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (result.ec != std::errc{}) fail("a number is needed behind #");
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    return number;
  }
  IfcValue value(int depth = 0) {
    if (depth > deepest_list) fail("its lists are nested too deep");
    IfcValue read;
    const char c = peek();
    if (take('$') || take('*')) return read;
    if (c == '\'' || c == '"') {
      read.kind = IfcValue::Kind::text;
      read.text = quoted(c);
    } else if (take('.')) {
      read.kind = IfcValue::Kind::enumeration;
      read.text = word();
      expect('.');
    } else if (c == '#') {
      read.kind = IfcValue::Kind::reference;
      read.reference = instance_number();
    } else if (c == '(') {
      read.kind = IfcValue::Kind::list;
      read.items = list(depth + 1);
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word();
      std::vector<IfcValue> typed = list(depth + 1);
      if (typed.size() == 1) return std::move(typed.front());
      read.kind = IfcValue::Kind::list;
      read.items = std::move(typed);
    } else {
      read.kind = IfcValue::Kind::number;
      read.number = number();
    }
    return read;
  }
  std::vector<IfcValue> list(int depth) {
    std::vector<IfcValue> items;
    expect('(');
    if (take(')')) return items;
    do {
      items.push_back(value(depth));
    } while (take(','));
    expect(')');
    return items;
  }
  /// To behind the next semicolon that is not within a text.
  void skip_statement() {
    while (!at_end()) {
      const char c = peek();
      if (c == '\'' || c == '"')
        quoted(c);
      else
        ++at_;
      if (c == ';') return;
    }
    fail("the file is cut off");
  }
  std::string place() const { return file_ + ":" + std::to_string(line_); }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("the text is no IFC here: " + what, place(), "export the file again");
  }

 private:
  void skip_blanks() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        if (text_[at_] == '\n') ++line_;
        ++at_;
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) fail("a comment does not end");
        line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                             text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ = end + 2;
      } else {
        return;
      }
    }
  }
  /// A doubled quote stands for one.
  std::string quoted(char quote) {
    std::string letters;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != quote) {
        letters += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == quote) {
        letters += text_[at_++];
      } else {
        ++at_;
        return letters;
      }
    }
    fail("a text does not end");
  }
  double number() {
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    double value = 0.0;
    const auto result = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (result.ec != std::errc{} || !std::isfinite(value))
      fail("a number is needed, found " + quoted_word(text_.substr(at_, 20)));
    at_ = static_cast<std::size_t>(result.ptr - text_.data());
    return value;
  }

  std::string_view text_;
  std::string file_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::string schema_in(Scanner& scanner) {
  const std::vector<IfcValue> names = scanner.list(0);
  scanner.expect(';');
  if (names.empty() || names.front().items.empty()) return {};
  return names.front().items.front().text;
}

}  // namespace

double IfcInstance::number_at(std::size_t i) const {
  if (i >= arguments.size() || arguments[i].kind != IfcValue::Kind::number)
    fail(name + " lacks the number that stands at place " + std::to_string(i + 1), "export it with all its values");
  return arguments[i].number;
}

double IfcInstance::number_or(std::size_t i, double otherwise) const {
  return i < arguments.size() && arguments[i].kind == IfcValue::Kind::number ? arguments[i].number : otherwise;
}

std::string IfcInstance::word_at(std::size_t i) const {
  return i < arguments.size() ? arguments[i].text : std::string();
}

std::uint64_t IfcInstance::reference_at(std::size_t i) const {
  return i < arguments.size() ? arguments[i].reference : 0;
}

std::vector<std::uint64_t> IfcInstance::references_at(std::size_t i) const {
  std::vector<std::uint64_t> numbers;
  if (i < arguments.size())
    for (const IfcValue& item : arguments[i].items) numbers.push_back(item.reference);
  return numbers;
}

std::vector<double> IfcInstance::numbers_at(std::size_t i) const {
  std::vector<double> numbers;
  if (i < arguments.size())
    for (const IfcValue& item : arguments[i].items) {
      if (item.kind != IfcValue::Kind::number) fail(name + ": a number is needed", "export the file again");
      numbers.push_back(item.number);
    }
  return numbers;
}

const IfcInstance& IfcText::at(std::uint64_t number, const IfcInstance& asked_by) const {
  const auto found = instances.find(number);
  if (found == instances.end())
    asked_by.fail(asked_by.name + " refers to #" + std::to_string(number) + ", which the file does not hold",
                  "export the whole file again");
  return found->second;
}

std::vector<const IfcInstance*> IfcText::named(const std::string& name) const {
  std::vector<const IfcInstance*> found;
  for (const auto& [number, instance] : instances)
    if (instance.name == name) found.push_back(&instance);
  return found;
}

IfcText read_ifc_text(const std::filesystem::path& file, const std::vector<std::string>& wanted) {
  const std::string text = as_utf8(read_text_file(file));
  Scanner scanner(text, file.string());
  IfcText read{file.string(), {}, {}};
  if (scanner.word() != "ISO-10303-21") scanner.fail("it does not begin with ISO-10303-21");
  scanner.expect(';');
  while (!scanner.at_end()) {
    if (scanner.peek() != '#') {
      const std::string word = scanner.word();
      if (word == "FILE_SCHEMA")
        read.schema = schema_in(scanner);
      else
        scanner.skip_statement();
      if (word == "END-ISO-10303-21") return read;
      continue;
    }
    IfcInstance instance;
    instance.place = scanner.place();
    instance.number = scanner.instance_number();
    scanner.expect('=');
    instance.name = scanner.word();
    const bool is_wanted = std::any_of(wanted.begin(), wanted.end(),
                                       [&](const std::string& begin) { return instance.name.starts_with(begin); });
    if (!is_wanted) {
      scanner.skip_statement();
      continue;
    }
    instance.arguments = scanner.list(0);
    scanner.expect(';');
    const std::uint64_t number = instance.number;
    if (!read.instances.emplace(number, std::move(instance)).second)
      scanner.fail("#" + std::to_string(number) + " is given twice");
  }
  scanner.fail("the file is cut off: it does not end with END-ISO-10303-21");
}

}  // namespace adit::io
