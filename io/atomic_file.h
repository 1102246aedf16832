#pragma once
// A file appears under its name only when it is whole: temporary in the same folder, fsync, rename, fsync of the
// folder.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace adit::io {

/// A file being written. Until commit() the name holds what it held before; destroyed without commit (an exception, a
/// cancelled run) it leaves nothing behind. A full disk, a missing folder and the like are Errors that name the file.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void append(std::string_view bytes);
  void append(std::span<const std::byte> bytes);

  /// Makes the file durable and gives it its name, in one step.
  void commit();

 private:
  void flush();
  void write_through(const char* bytes, std::size_t count);
  void start_writeback(std::uint64_t written);
  void close();
  [[noreturn]] void fail(const std::string& what_is_wrong, int error_number) const;

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  std::uint64_t given_to_disk_ = 0;
  std::string buffer_;
};

/// Removes from a folder (not those below it) the temporaries of processes that were killed.
void remove_leftovers(const std::filesystem::path& folder);

/// The whole content at once.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace adit::io
