#pragma once
// Cells of the tables that Adit writes.

#include <cmath>
#include <cstdio>
#include <string>

namespace adit::io {

/// A number with fixed decimals; empty when it is not finite.
inline std::string csv_number(double value, int decimals) {
  if (!std::isfinite(value)) return {};
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

/// A word in quotes, quotes doubled, where it holds what would end a cell.
inline std::string cell_word(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace adit::io
