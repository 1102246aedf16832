#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t block_bytes = std::size_t{1} << 20;
constexpr std::size_t large_bytes = std::size_t{1} << 18;  // written without a copy

/// The file a name stands for: a link is followed, so that the link stays and its file is replaced.
fs::path followed(const fs::path& target) {
  std::error_code ignored;
  if (!fs::is_symlink(target, ignored)) return target;
  const fs::path real = fs::weakly_canonical(target, ignored);
  return real.empty() ? target : real;
}

fs::path folder_of(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

fs::path temporary_name(const fs::path& target, unsigned attempt) {
  static std::atomic<unsigned> counter{0};  // two files of one process never share a temporary
  const std::string ending = ".adit-" + std::to_string(::getpid()) + "-" + std::to_string(counter++ + attempt) + ".tmp";
  // File systems end a name at 255 bytes.
  return folder_of(target) / ("." + target.filename().string().substr(0, 200) + ending);
}

/// The process that named a temporary; empty for any other file.
std::optional<pid_t> maker_of(const std::string& name) {
  constexpr std::string_view mark = ".adit-";
  const auto at = name.rfind(mark);
  if (!name.starts_with('.') || !name.ends_with(".tmp") || at == std::string::npos) return std::nullopt;
  pid_t maker = 0;
  const char* const begin = name.data() + at + mark.size();
  const auto read = std::from_chars(begin, name.data() + name.size(), maker);
  if (read.ec != std::errc{} || *read.ptr != '-' || maker <= 0) return std::nullopt;
  return maker;
}

std::string mend_for(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or write to another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a folder you may write to";
    default:
      return "check the folder and the disk";
  }
}

}  // namespace

AtomicPath::AtomicPath(fs::path target) : target_(followed(target)) {
  std::error_code ignored;
  if (target_.filename().empty() || fs::is_directory(target_, ignored))
    throw Error("this is a folder, not a file", target_.string(), "name a file inside it");
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored))
    throw Error("this is a pipe or a device, not a file", target_.string(), "name a file");
  if (!fs::is_directory(folder_of(target_), ignored))
    throw Error("there is no folder " + folder_of(target_).string(), target_.string(), "make the folder first");
  int descriptor = -1;
  for (unsigned attempt = 0; descriptor < 0 && attempt < 100; ++attempt) {
    temporary_ = temporary_name(target_, attempt);
    descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) fail("the file cannot be made", errno);
  }
  if (descriptor < 0) fail("the file cannot be made", EEXIST);
  ::close(descriptor);
}

AtomicPath::~AtomicPath() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicPath::commit() {
  const int file = ::open(temporary_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) fail("the file cannot be written", errno);
  const int synced = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (synced != 0) fail("the file cannot be written", synced);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("the file cannot be given its name", errno);
  temporary_.clear();
  const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);  // some file systems refuse this for folders; the file itself is safe by then
  ::close(folder);
}

void AtomicPath::fail(const std::string& what_is_wrong, int error_number) const {
  throw Error(what_is_wrong + " (" + std::strerror(error_number) + ")", target_.string(), mend_for(error_number));
}

AtomicFile::AtomicFile(fs::path target) : path_(std::move(target)) {
  descriptor_ = ::open(path_.temporary().c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) path_.fail("the file cannot be made", errno);
}

AtomicFile::~AtomicFile() {
  close();
}

void AtomicFile::append(std::string_view bytes) {
  if (bytes.size() >= large_bytes) {
    flush();
    write_through(bytes.data(), bytes.size());
    return;
  }
  buffer_.append(bytes);
  if (buffer_.size() >= block_bytes) flush();
}

void AtomicFile::append(std::span<const std::byte> bytes) {
  append(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void AtomicFile::commit() {
  flush();
  close();
  path_.commit();
}

void AtomicFile::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void AtomicFile::write_through(const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = ::write(descriptor_, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) path_.fail("the file cannot be written", errno);
    start_writeback(static_cast<std::uint64_t>(written));
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

/// Lets the disk begin while the file grows, so that the fsync of a large file has little left to wait for.
void AtomicFile::start_writeback(std::uint64_t written) {
  constexpr std::uint64_t stretch_bytes = std::uint64_t{8} << 20;
  size_ += written;
  if (size_ - given_to_disk_ < stretch_bytes) return;
  ::sync_file_range(descriptor_, static_cast<off64_t>(given_to_disk_), static_cast<off64_t>(size_ - given_to_disk_),
                    SYNC_FILE_RANGE_WRITE);
  given_to_disk_ = size_;
}

void AtomicFile::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void remove_leftovers(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto maker = maker_of(entry.path().filename().string());
    if (maker && ::kill(*maker, 0) != 0 && errno == ESRCH) ::unlink(entry.path().c_str());
  }
}

void write_file_atomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.append(bytes);
  file.commit();
}

}  // namespace adit::io
