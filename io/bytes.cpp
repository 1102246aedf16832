#include "io/bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;
constexpr const char* cut_short = "the file is cut short; copy or export it again";

std::string system_words() {
  return std::strerror(errno);
}

}  // namespace

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)) {
  struct stat facts = {};
  if (::stat(path_.c_str(), &facts) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) throw Error("no such file", name(), "check the name and the folder");
    throw Error("the file cannot be opened (" + system_words() + ")", name(), "check its permissions");
  }
  if (S_ISDIR(facts.st_mode)) throw Error("this is a folder, not a file", name(), "name a file inside it");
  if (!S_ISREG(facts.st_mode)) throw Error("this is not a regular file", name(), "name a file on a disk");
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error("the file cannot be opened (" + system_words() + ")", name(), "check its permissions");
  size_ = static_cast<std::uint64_t>(facts.st_size);
}

InputFile::~InputFile() {
  ::close(descriptor_);
}

std::string InputFile::at_byte(std::uint64_t offset) const {
  return name() + ": byte " + std::to_string(offset);
}

std::size_t InputFile::read_some(std::uint64_t offset, void* to, std::size_t count) const {
  if (offset >= size_) return 0;
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset));
  std::size_t done = 0;
  while (done < wanted) {
    const ssize_t got =
        ::pread(descriptor_, static_cast<std::byte*>(to) + done, wanted - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw Error("the file cannot be read (" + system_words() + ")", at_byte(offset + done), "check the disk");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void InputFile::read(std::uint64_t offset, std::byte* to, std::size_t count, std::string_view what) const {
  if (read_some(offset, to, count) < count)
    throw Error("the file of " + std::to_string(size_) + " bytes ends inside " + std::string(what), at_byte(offset),
                cut_short);
}

std::vector<std::byte> InputFile::read(std::uint64_t offset, std::size_t count, std::string_view what) const {
  if (offset > size_ || count > size_ - offset)
    throw Error("the file of " + std::to_string(size_) + " bytes ends inside " + std::string(what), at_byte(offset),
                cut_short);
  std::vector<std::byte> bytes(count);
  read(offset, bytes.data(), count, what);
  return bytes;
}

std::string InputFile::beginning(std::size_t count) const {
  std::string bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, size_)), '\0');
  bytes.resize(read_some(0, bytes.data(), bytes.size()));
  return bytes;
}

void InputFile::expect_records(std::uint64_t offset, std::uint64_t count, std::uint64_t record_size,
                               std::string_view what) const {
  const std::uint64_t bytes = offset < size_ ? size_ - offset : 0;
  if (record_size == 0 || count <= bytes / record_size) return;
  throw Error("the header says " + std::to_string(count) + " " + std::string(what) + ", the file has room for " +
                  std::to_string(bytes / record_size) + " at most",
              at_byte(offset), cut_short);
}

ByteCursor::ByteCursor(const InputFile& file, std::uint64_t begin, std::uint64_t end)
    : file_(file), end_(std::min(end, file.size())), buffer_offset_(begin) {}

void ByteCursor::refill(std::size_t count) {
  const std::uint64_t from = position();
  if (from > end_ || count > end_ - from) ended(count);
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(std::max(count, block_bytes), end_ - from));
  if (buffer_.size() < size) buffer_.resize(size);
  buffer_offset_ = from;
  next_ = 0;
  filled_ = file_.read_some(from, buffer_.data(), size);
  if (filled_ < count) ended(count);
}

void ByteCursor::skip(std::uint64_t count) {
  const std::uint64_t from = position();
  if (from > end_ || count > end_ - from) ended(count);
  if (count <= filled_ - next_) {
    next_ += static_cast<std::size_t>(count);
  } else {
    buffer_offset_ = from + count;
    next_ = filled_ = 0;
  }
}

void ByteCursor::ended(std::uint64_t count) const {
  throw Error(std::to_string(count) + " more bytes are needed, the file ends after " +
                  std::to_string(position() < end_ ? end_ - position() : 0),
              file_.at_byte(position()), cut_short);
}

}  // namespace adit::io
