#include "app/step_record.h"

#include <sstream>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/sha256.h"
#include "io/text_file.h"

namespace adit::app {

namespace fs = std::filesystem;

StepRecord::StepRecord(fs::path out, const std::string& step)
    : out_(std::move(out)), file_(out_ / "steps" / (step + ".key")) {}

bool StepRecord::holds(const std::string& key, Progress& progress) const {
  std::error_code ignored;
  if (!fs::is_regular_file(file_, ignored)) return false;
  try {
    std::istringstream lines(io::read_text_file(file_));
    std::string line;
    if (!std::getline(lines, line) || line != key) return false;
    while (std::getline(lines, line)) {
      const auto blank = line.find(' ');
      if (blank == std::string::npos) return false;
      if (io::sha256_of_file(out_ / line.substr(blank + 1), progress) != line.substr(0, blank)) return false;
    }
    return true;
  } catch (const Error&) {
    return false;  // a file is missing or cannot be read
  }
}

void StepRecord::remove() const {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

void StepRecord::write(const std::string& key, const LeftFiles& files, Progress& progress) const {
  std::string text = key + "\n";
  for (const fs::path& file : files)
    text += io::sha256_of_file(out_ / file, progress) + " " + file.generic_string() + "\n";
  io::write_file_atomically(file_, text);
}

}  // namespace adit::app
