#include "core/foundation/options.h"

#include <charconv>
#include <cmath>

namespace adit {

std::string short_number(double value) {
  char text[64];
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-6 && size < 1e9);  // 0.00002, not 2e-05
  const auto end = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr
                         : std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

}  // namespace adit
