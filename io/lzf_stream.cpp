#include "io/lzf_stream.h"

#include <algorithm>
#include <vector>

#include "core/foundation/error.h"

namespace adit::io {

void LzfStream::damaged() const {
  throw Error("the points cannot be unpacked", file_->at_byte(packed_.position()),
              "the file is damaged; copy or export it again");
}

/// A control byte: a run of literals, or a length and how far back to copy from.
void LzfStream::next_piece() {
  if (packed_.position() >= end_) damaged();
  const auto control = std::to_integer<unsigned>(*packed_.take(1));
  if (control < 32) {
    literals_ = control + 1;
    return;
  }
  unsigned length = control >> 5;
  if (length == 7) length += std::to_integer<unsigned>(*packed_.take(1));
  copies_ = length + 2;
  back_ = ((control & 31U) << 8 | std::to_integer<unsigned>(*packed_.take(1))) + 1;
  if (back_ > unpacked_) damaged();
}

std::byte LzfStream::next_byte() {
  if (literals_ == 0 && copies_ == 0) next_piece();
  std::byte byte{};
  if (literals_ > 0) {
    --literals_;
    byte = *packed_.take(1);
  } else {
    --copies_;
    byte = window_[(unpacked_ - back_) % window_bytes];
  }
  window_[unpacked_++ % window_bytes] = byte;
  return byte;
}

void LzfStream::read(std::span<std::byte> to) {
  for (std::byte& byte : to) byte = next_byte();
}

void LzfStream::skip(std::uint64_t count, const Progress& progress) {
  std::vector<std::byte> passed(65536);
  while (count > 0) {
    progress.check();
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(count, passed.size()));
    read(std::span(passed).first(part));
    count -= part;
  }
}

}  // namespace adit::io
