#include "io/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/foundation/error.h"
#include "io/bytes.h"

namespace adit::io {

MappedFile::MappedFile(const std::filesystem::path& path) {
  const InputFile checked(path);
  if (checked.size() == 0) return;  // the system maps no empty files
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const auto size = static_cast<std::size_t>(checked.size());
  void* begin = descriptor < 0 ? MAP_FAILED : ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
  const std::string words = std::strerror(errno);
  if (descriptor >= 0) ::close(descriptor);
  if (begin == MAP_FAILED) throw Error("the file cannot be mapped (" + words + ")", path.string(), "check the disk");
  bytes_ = {static_cast<const std::byte*>(begin), size};
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::release(std::uint64_t offset, std::size_t count) const {
  const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t begin = (offset + page - 1) / page * page;
  const std::uint64_t end = (offset + count) / page * page;
  if (begin < end) ::madvise(const_cast<std::byte*>(bytes_.data() + begin), end - begin, MADV_DONTNEED);
}

}  // namespace adit::io
