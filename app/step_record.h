#pragma once
// out/steps/NAME.key: what a step depended on, and the hashes of the files it left.

#include <filesystem>
#include <string>
#include <vector>

#include "core/foundation/progress.h"

namespace adit::app {

/// Names of files, relative to the folder of everything derived.
using LeftFiles = std::vector<std::filesystem::path>;

class StepRecord {
 public:
  StepRecord(std::filesystem::path out, const std::string& step);

  /// True when the step was last run with this key and every file it left is as it was, to the last bit.
  bool holds(const std::string& key, Progress& progress) const;
  /// Before a step runs: until it is whole again, nothing says that it is.
  void remove() const;
  /// After a step has run. Throws Error when a file is not there or the record cannot be written.
  void write(const std::string& key, const LeftFiles& files, Progress& progress) const;

 private:
  std::filesystem::path out_;
  std::filesystem::path file_;
};

}  // namespace adit::app
