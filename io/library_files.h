#pragma once
// Data files that are built in.

#include <string>
#include <vector>

namespace adit::io {

/// A file as it was built in; its name is without ending.
struct LibraryFile {
  const char* name;
  const char* json;
};
const std::vector<LibraryFile>& profile_files();    ///< assets/profiles
const std::vector<LibraryFile>& tolerance_files();  ///< assets/tolerances

/// "circle, rectangle".
inline std::string names_of(const std::vector<LibraryFile>& files) {
  std::string names;
  for (const LibraryFile& file : files) names += (names.empty() ? "" : ", ") + std::string(file.name);
  return names;
}

}  // namespace adit::io
