#pragma once
// The ending of a file's name, in lower case, with its dot: ".csv".

#include <cctype>
#include <filesystem>
#include <string>

namespace adit::io {

inline std::string lower_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace adit::io
