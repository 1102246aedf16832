#pragma once
// The one gate to files that others wrote: bounded reads, and counts compared with the file's size before memory is
// taken.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adit::io {

/// The T stored at `from` in the given byte order. T is an arithmetic type.
template <typename T>
T stored_as(std::endian order, const std::byte* from) {
  std::byte bytes[sizeof(T)];
  if (order == std::endian::native) {
    std::memcpy(bytes, from, sizeof(T));
  } else {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = from[sizeof(T) - 1 - i];
  }
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}
template <typename T>
T little(const std::byte* from) {
  return stored_as<T>(std::endian::little, from);
}
template <typename T>
T big(const std::byte* from) {
  return stored_as<T>(std::endian::big, from);
}

/// Puts a number behind bytes, in the given order.
template <typename T>
void append_stored(std::string& bytes, T value, std::endian order) {
  char stored[sizeof(T)];
  std::memcpy(stored, &value, sizeof(T));
  if (order != std::endian::native)
    for (std::size_t i = 0; 2 * i + 1 < sizeof(T); ++i) std::swap(stored[i], stored[sizeof(T) - 1 - i]);
  bytes.append(stored, sizeof(T));
}

/// A regular file opened for reading. Every failure is an Error that names the file and, where there is one, the byte.
class InputFile {
 public:
  /// Error when the file is missing, a folder, a device or not readable.
  explicit InputFile(std::filesystem::path path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// The path as the caller gave it, for messages.
  std::string name() const { return path_.string(); }
  /// Size in bytes when the file was opened.
  std::uint64_t size() const { return size_; }
  /// "scan.las: byte 96", for messages.
  std::string at_byte(std::uint64_t offset) const;

  /// Exactly `count` bytes from `offset`. Error when the file ends before; `what` says what was looked for.
  void read(std::uint64_t offset, std::byte* to, std::size_t count, std::string_view what) const;
  std::vector<std::byte> read(std::uint64_t offset, std::size_t count, std::string_view what) const;

  /// Up to `count` bytes from `offset`; fewer only at the end of the file. Returns how many.
  std::size_t read_some(std::uint64_t offset, void* to, std::size_t count) const;
  /// Up to `count` bytes from the beginning, for signatures and headers.
  std::string beginning(std::size_t count) const;

  /// Error with both counts unless `count` records of at least `record_size` bytes lie between `offset` and the end.
  /// `what` is the plural word for the records ("points").
  void expect_records(std::uint64_t offset, std::uint64_t count, std::uint64_t record_size,
                      std::string_view what) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Walks through a part of a file record by record, with a buffer of its own.
class ByteCursor {
 public:
  ByteCursor(const InputFile& file, std::uint64_t begin, std::uint64_t end);

  /// The next `count` bytes, valid until the next call. Error when the part ends before.
  const std::byte* take(std::size_t count) {
    if (count > filled_ - next_) refill(count);
    const std::byte* bytes = buffer_.data() + next_;
    next_ += count;
    return bytes;
  }
  /// Passes over `count` bytes. Error when the part ends before.
  void skip(std::uint64_t count);
  /// Offset in the file of the next byte.
  std::uint64_t position() const { return buffer_offset_ + next_; }

 private:
  void refill(std::size_t count);
  [[noreturn]] void ended(std::uint64_t count) const;

  const InputFile& file_;
  std::uint64_t end_;
  std::uint64_t buffer_offset_;
  std::vector<std::byte> buffer_;
  std::size_t next_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace adit::io
