#pragma once
// LZF, the compression inside PCD files, unpacked as a stream.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/foundation/progress.h"
#include "io/bytes.h"

namespace adit::io {

/// Unpacks the bytes [begin, end) of a file in order. LZF copies from at most 8 KiB back, so that is all it remembers.
/// Error with the byte when the packed data is not sound, or ends before what is asked for.
class LzfStream {
 public:
  LzfStream(const InputFile& file, std::uint64_t begin, std::uint64_t end)
      : file_(&file), packed_(file, begin, end), end_(end) {}

  void read(std::span<std::byte> to);
  void skip(std::uint64_t count, const Progress& progress);

 private:
  void next_piece();
  std::byte next_byte();
  [[noreturn]] void damaged() const;

  static constexpr std::size_t window_bytes = 8192;
  const InputFile* file_;
  ByteCursor packed_;
  std::uint64_t end_;
  std::array<std::byte, window_bytes> window_{};
  std::uint64_t unpacked_ = 0;  ///< bytes so far
  unsigned literals_ = 0;       ///< left of the present run
  unsigned copies_ = 0;         ///< left of the present copy
  unsigned back_ = 0;           ///< how far the copy reaches back
};

}  // namespace adit::io
