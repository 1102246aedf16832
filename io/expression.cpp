#include "io/expression.h"

#include <cctype>
#include <charconv>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/foundation/error.h"
#include "io/text_place.h"

namespace adit::io {
namespace {

constexpr int deepest = 50;

/// Recursive descent: sum, product, value.
class Formula {
 public:
  Formula(const std::string& text, const std::map<std::string, double>& values) : text_(text), values_(values) {}

  double whole() {
    const double value = sum();
    skip_blanks();
    if (at_ < text_.size()) fail("has \"" + text_.substr(at_, 1) + "\" where an operator belongs");
    if (!std::isfinite(value)) fail("gives no finite number");
    return value;
  }

 private:
  double sum() {
    double value = product();
    while (true) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = factor();
    while (true) {
      if (take('*')) {
        value *= factor();
      } else if (take('/')) {
        const double by = factor();
        if (by == 0.0) fail("divides by zero");
        value /= by;
      } else {
        return value;
      }
    }
  }
  double factor() {
    if (++depth_ > deepest) fail("is nested too deep");
    const double value = take('-') ? -factor() : take('(') ? in_brackets() : name_or_number();
    --depth_;
    return value;
  }
  double in_brackets() {
    const double value = sum();
    if (!take(')')) fail("lacks a closing bracket");
    return value;
  }
  double name_or_number() {
    skip_blanks();
    if (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) return name();
    double value = 0.0;
    const char* const begin = text_.data() + at_;
    const auto result = std::from_chars(begin, text_.data() + text_.size(), value);
    if (result.ec != std::errc{}) fail("lacks a number");
    at_ += static_cast<std::size_t>(result.ptr - begin);
    return value;
  }
  double name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (take('(')) return function(word, in_brackets());
    const auto found = values_.find(word);
    if (found == values_.end()) fail("names " + quoted_word(word) + ", which is no size");
    return found->second;
  }
  double function(const std::string& word, double value) {
    if (word == "sqrt" && value < 0.0) fail("takes the root of a negative number: these sizes make no profile");
    if (word == "sqrt") return std::sqrt(value);
    if (word == "sin") return std::sin(rad_from_deg(value));
    if (word == "cos") return std::cos(rad_from_deg(value));
    if (word == "tan") return std::tan(rad_from_deg(value));
    fail("calls " + quoted_word(word) + ", which is none of sqrt, sin, cos, tan");
  }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("the formula " + quoted_word(text_) + " " + what);
  }

  const std::string& text_;
  const std::map<std::string, double>& values_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

double evaluate(const std::string& formula, const std::map<std::string, double>& values) {
  return Formula(formula, values).whole();
}

}  // namespace adit::io
