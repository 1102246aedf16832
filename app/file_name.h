#pragma once
// Names of scans as parts of file names.

#include <string>

namespace adit::app {

/// At most so many bytes, letters and digits of ASCII, - and _; an underscore for anything else.
std::string in_file_name(const std::string& name, std::size_t most);

}  // namespace adit::app
