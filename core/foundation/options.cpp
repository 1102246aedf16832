#include "core/foundation/options.h"

#include <charconv>

namespace adit {

std::string short_number(double value) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return std::string(text, end);
}

}  // namespace adit
