#pragma once
// Content hashes: SHA-256 of files and bytes.

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/foundation/progress.h"

namespace adit::io {

/// A hash being made. hex() ends it.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  /// 64 lower-case hexadecimal digits; nothing may be added afterwards.
  std::string hex();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

std::string sha256_of_bytes(std::string_view bytes);

/// Hash of a file's content, read in blocks. Error as InputFile; Cancelled within a block of 4 MiB.
std::string sha256_of_file(const std::filesystem::path& file, Progress& progress);

}  // namespace adit::io
