#pragma once
// A small text file as a whole.

#include <filesystem>
#include <string>

namespace adit::io {

/// Content of a file of at most 256 MiB. Error when it is missing, larger or not readable.
std::string read_text_file(const std::filesystem::path& file);

}  // namespace adit::io
