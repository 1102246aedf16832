#pragma once
// Whether a file is still the one that was looked at.

#include <cstdint>
#include <filesystem>

namespace adit::io {

/// What the file system says of a file; two stamps differ when its content was changed in between.
struct FileStamp {
  std::uint64_t bytes = 0;
  std::uint64_t number = 0;  ///< of the file in its file system
  std::int64_t changed_ns = 0;

  bool operator==(const FileStamp&) const = default;
};

/// All zero for a file that cannot be looked at.
FileStamp stamp_of(const std::filesystem::path& file);

}  // namespace adit::io
