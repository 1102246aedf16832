#include "render/number_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace adit::render {
namespace {

constexpr const char* minus = "\u2212";
constexpr const char* nothing = "\u2013";

std::string digits(double magnitude, int decimals) {
  char buffer[400];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, magnitude, std::chars_format::fixed, decimals);
  return error == std::errc() ? std::string(buffer, end) : std::string(nothing);
}

bool all_zero(const std::string& text) {
  return text.find_first_of("123456789") == std::string::npos;
}

}  // namespace

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return nothing;
  const std::string text = digits(std::abs(value), decimals);
  return value < 0.0 && !all_zero(text) ? minus + text : text;
}

std::string with_sign(double value, int decimals) {
  const std::string text = fixed(value, decimals);
  return std::isfinite(value) && value > 0.0 && !all_zero(text) ? "+" + text : text;
}

std::string grouped(unsigned long long value) {
  std::string text = std::to_string(value);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string percent(double share, int decimals) {
  if (!std::isfinite(share)) return nothing;
  const double scale = std::pow(10.0, decimals + 2);
  const double steps = std::round(share * scale);
  const double shown = share < 1.0 && steps >= scale ? scale - 1.0 : steps;
  return fixed(shown / std::pow(10.0, decimals), decimals) + "\u00a0%";
}

}  // namespace adit::render
