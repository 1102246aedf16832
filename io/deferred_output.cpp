#include "io/deferred_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace adit::io {

DeferredOutput::DeferredOutput(const std::filesystem::path& file) : buffer_(std::size_t{1} << 16) {
  descriptor_ = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) error_ = errno;
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

DeferredOutput::~DeferredOutput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int DeferredOutput::flushed_error() {
  sync();
  return error_;
}

DeferredOutput::int_type DeferredOutput::overflow(int_type character) {
  sync();
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  return sputc(traits_type::to_char_type(character));
}

int DeferredOutput::sync() {
  const char* from = pbase();
  while (error_ == 0 && from < pptr()) {
    const auto offset = static_cast<off_t>(at_ + static_cast<std::uint64_t>(from - pbase()));
    const ssize_t written = ::pwrite(descriptor_, from, static_cast<std::size_t>(pptr() - from), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) error_ = errno;
    from += std::max<ssize_t>(written, 0);
  }
  at_ += waiting();
  end_ = std::max(end_, at_);
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return 0;
}

DeferredOutput::pos_type DeferredOutput::seekoff(off_type offset, std::ios_base::seekdir from,
                                                 std::ios_base::openmode which) {
  const std::uint64_t here = at_ + waiting();
  if (from == std::ios_base::cur && offset == 0) return {static_cast<off_type>(here)};
  const off_type base = from == std::ios_base::beg   ? 0
                        : from == std::ios_base::cur ? static_cast<off_type>(here)
                                                     : static_cast<off_type>(std::max(end_, here));
  return seekpos(base + offset, which);
}

DeferredOutput::pos_type DeferredOutput::seekpos(pos_type position, std::ios_base::openmode) {
  const auto offset = static_cast<off_type>(position);
  if (offset < 0) return {off_type(-1)};
  sync();
  at_ = static_cast<std::uint64_t>(offset);
  return position;
}

}  // namespace adit::io
