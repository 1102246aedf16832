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

/// A temporary in the folder of its target, for a library that writes to a name. Until commit() the target holds what
/// it held before; destroyed without commit (an exception, a cancelled run) it leaves nothing behind. A missing folder
/// and the like are Errors that name the target.
class AtomicPath {
 public:
  /// Makes the temporary, empty.
  explicit AtomicPath(std::filesystem::path target);
  ~AtomicPath();
  AtomicPath(const AtomicPath&) = delete;
  AtomicPath& operator=(const AtomicPath&) = delete;

  const std::filesystem::path& target() const { return target_; }
  /// The name to write to.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Makes what was written durable and gives it its name, in one step.
  void commit();

  /// Error about the target with the system's words for `error_number` and a mend that fits them.
  [[noreturn]] void fail(const std::string& what_is_wrong, int error_number) const;

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
};

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

  AtomicPath path_;
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
