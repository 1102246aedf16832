#pragma once
// The ending of a file's name, in lower case, with its dot: ".csv".

#include <filesystem>
#include <string>

#include "io/character_set.h"

namespace adit::io {

inline std::string lower_ending(const std::filesystem::path& file) {
  return lower_case(file.extension().string());
}

}  // namespace adit::io
