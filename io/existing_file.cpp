#include "io/existing_file.h"

#include "io/text_place.h"

namespace adit::io {

namespace fs = std::filesystem;

std::string existing_file(const JsonPlace& place, const fs::path& folder) {
  const std::string name = place.text();
  if (name.empty()) place.refuse("the name of a file is needed", "write it relative to the job's folder");
  std::error_code error;
  if (!fs::exists(folder / name, error))
    place.refuse("there is no file " + quoted_word(name), "paths are relative to the folder of job.json");
  if (fs::is_directory(folder / name, error)) place.refuse(quoted_word(name) + " is a folder", "name a file");
  return name;
}

}  // namespace adit::io
