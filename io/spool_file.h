#pragma once
// Bytes that memory should not hold, kept on disk for a while.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace adit::io {

/// A file without a name in a folder; its space is free again when the program ends, however it ends.
class SpoolFile {
 public:
  explicit SpoolFile(std::filesystem::path folder) : folder_(std::move(folder)) {}
  ~SpoolFile();
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;

  /// Adds bytes; returns their offset. Error when the disk is full. The file is made by the first call.
  std::uint64_t append(const void* bytes, std::size_t count);
  void read(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  std::filesystem::path folder_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace adit::io
