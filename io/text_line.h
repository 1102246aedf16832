#pragma once
// One line of numbers on its way into a text file; the locale has no say.

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace adit::io {

/// Collects words and numbers with a separator between them.
class TextLine {
 public:
  explicit TextLine(char separator = ' ') : separator_(separator) {}

  /// The shortest decimal form that gives the same float again.
  TextLine& add(float value) {
    return add_with([&](char* from, char* to) { return std::to_chars(from, to, value); });
  }
  /// A fixed number of decimals.
  TextLine& add(double value, int decimals) {
    return add_with(
        [&](char* from, char* to) { return std::to_chars(from, to, value, std::chars_format::fixed, decimals); });
  }
  TextLine& add(unsigned value) {
    return add_with([&](char* from, char* to) { return std::to_chars(from, to, value); });
  }
  TextLine& add(std::string_view word) {
    if (!text_.empty()) text_ += separator_;
    text_ += word;
    return *this;
  }

  /// The line with its end; call clear() before the next one.
  const std::string& ended() { return text_ += '\n'; }
  void clear() { text_.clear(); }

 private:
  template <typename Write>
  TextLine& add_with(const Write& write) {
    char number[400];  // the longest fixed double has 309 digits before the point
    const auto end = write(number, number + sizeof number).ptr;
    return add(std::string_view(number, static_cast<std::size_t>(end - number)));
  }

  char separator_;
  std::string text_;
};

}  // namespace adit::io
