#pragma once
// A whole file of ours in the address space, read-only.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace adit::io {

/// A read-only memory map of a regular file; no bytes for an empty one. Error as InputFile.
class MappedFile {
 public:
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return bytes_; }
  /// Lets the pages that lie wholly within these bytes leave the program's memory; they come back when they are read.
  void release(std::uint64_t offset, std::size_t count) const;

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace adit::io
