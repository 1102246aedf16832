#pragma once
// Text that others wrote, as UTF-8.

#include <string>
#include <string_view>

namespace adit::io {

/// The text itself when it is UTF-8, else taken as Latin-1.
std::string as_utf8(std::string text);

/// ASCII letters in lower case.
std::string lower_case(std::string text);

/// Where character `n` of a UTF-8 text begins, counted from 0; its size when it has fewer.
std::size_t character_at(std::string_view utf8, std::size_t n);

}  // namespace adit::io
