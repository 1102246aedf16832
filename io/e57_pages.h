#pragma once
// The pages of an E57 file (ASTM E2807, 7.1): 1020 bytes of content and their checksum each. Adit checks the checksums
// itself, beside the library, whose own way takes a third of the time that reading takes.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes.h"

namespace adit::io {

/// A part of the file, checksums and all: bytes [begin, end).
struct E57Part {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// The part that begins at a byte and holds so much content. Error, named after `what`, when the file does not hold it.
E57Part e57_part(const InputFile& file, std::uint64_t begin, std::uint64_t content_bytes, std::string_view what);

/// The content of a part, of pages whose checksums are right. The caller has judged its length. Error otherwise.
std::string read_e57_content(const InputFile& file, const E57Part& part, std::string_view what);

/// Where the records of a scan lie, from the section's own header. `begin`: as the XML states it. Error when no such
/// section stands there.
E57Part e57_records_part(const InputFile& file, std::uint64_t begin);

/// Checks the pages of a part in their order, somewhat ahead of one who reads it, so that the file is loaded once.
class E57PageCheck {
 public:
  E57PageCheck(const InputFile& file, const E57Part& part);

  /// Checks all up to this share (0 .. 1) of the part and a margin beyond. Error that names the page's first byte.
  void ahead_of(double share);
  /// Checks what is left.
  void rest();

 private:
  void up_to(std::uint64_t end);

  const InputFile& file_;
  E57Part part_;
  std::uint64_t next_;  ///< byte at which the first page not yet checked begins
  std::vector<std::byte> buffer_;
};

}  // namespace adit::io
