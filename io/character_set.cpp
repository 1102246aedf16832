#include "io/character_set.h"

#include <cctype>

namespace adit::io {
namespace {

bool is_utf8(std::string_view text) {
  int following = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (following > 0) {
      if ((byte & 0xC0U) != 0x80U) return false;
      --following;
    } else if (byte >= 0x80U) {
      if (byte >= 0xC2U && byte <= 0xDFU)
        following = 1;
      else if (byte >= 0xE0U && byte <= 0xEFU)
        following = 2;
      else if (byte >= 0xF0U && byte <= 0xF4U)
        following = 3;
      else
        return false;
    }
  }
  return following == 0;
}

std::string utf8_from_latin1(std::string_view text) {
  std::string converted;
  converted.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80U) {
      converted += c;
    } else {
      converted += static_cast<char>(0xC0U | (byte >> 6U));
      converted += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return converted;
}

}  // namespace

std::string as_utf8(std::string text) {
  return is_utf8(text) ? text : utf8_from_latin1(text);
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::size_t character_at(std::string_view utf8, std::size_t n) {
  std::size_t at = 0;
  for (; at < utf8.size(); ++at) {
    const bool begins = (static_cast<unsigned char>(utf8[at]) & 0xC0U) != 0x80U;
    if (begins && n-- == 0) break;
  }
  return at;
}

}  // namespace adit::io
