#include "io/spool_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/foundation/error.h"
#include "io/atomic_file.h"

namespace adit::io {

SpoolFile::~SpoolFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::uint64_t SpoolFile::append(const void* bytes, std::size_t count) {
  const auto fail = [&](const std::string& what) {
    throw Error(what + " (" + std::strerror(errno) + ")", folder_.string(),
                errno == ENOSPC || errno == EDQUOT ? "free some space or write to another disk"
                                                   : "check the folder and the disk");
  };
  if (descriptor_ < 0) {
    const AtomicPath named(folder_ / "spool");  // its name goes at the end of this block, the file when it is closed
    descriptor_ = ::open(named.temporary().c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor_ < 0) fail("the spool file cannot be made");
  }
  const std::uint64_t at = size_;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const ssize_t written = ::pwrite(descriptor_, from, count, static_cast<off_t>(size_));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("the spool file cannot be written");
    from += written;
    size_ += static_cast<std::uint64_t>(written);
    count -= static_cast<std::size_t>(written);
  }
  return at;
}

void SpoolFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  char* place = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = ::pread(descriptor_, place, count, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) throw Error("the spool file cannot be read", folder_.string(), "check the disk");
    place += got;
    offset += static_cast<std::uint64_t>(got);
    count -= static_cast<std::size_t>(got);
  }
}

}  // namespace adit::io
