#include "io/e57_pages.h"

#include <isa-l/crc.h>

#include <algorithm>

#include "core/foundation/error.h"

namespace adit::io {
namespace {

constexpr std::uint64_t page_bytes = 1024;
constexpr std::uint64_t page_content_bytes = 1020;
constexpr std::uint64_t section_header_bytes = 32;
constexpr std::byte section_of_records{1};
/// So far ahead of a reader whose place is known about: packets have 64 kB, and a reader keeps some of them.
constexpr std::uint64_t margin_bytes = std::uint64_t{8} << 20;
constexpr std::size_t pages_at_once = 256;
constexpr const char* damaged = "the file is damaged; copy or export it again";

/// CRC-32C (Castagnoli) of the content, the foremost byte first.
bool is_whole(const std::byte* page) {
  // The function takes what is not const and changes nothing.
  auto* content = const_cast<unsigned char*>(reinterpret_cast<const unsigned char*>(page));
  return ~crc32_iscsi(content, int{page_content_bytes}, 0xFFFFFFFFU) == big<std::uint32_t>(page + page_content_bytes);
}

std::uint64_t content_before(std::uint64_t byte) {
  return byte / page_bytes * page_content_bytes + byte % page_bytes;
}

}  // namespace

E57Part e57_part(const InputFile& file, std::uint64_t begin, std::uint64_t content_bytes, std::string_view what) {
  if (begin >= file.size() || begin % page_bytes >= page_content_bytes)
    throw Error(std::string(what) + " cannot stand at byte " + std::to_string(begin), file.name(), damaged);
  if (content_bytes == 0 || content_bytes > file.size() - begin)
    throw Error(std::string(what) + " cannot have " + std::to_string(content_bytes) + " bytes", file.at_byte(begin),
                damaged);
  const std::uint64_t last = content_before(begin) + content_bytes - 1;
  const E57Part part{begin, last / page_content_bytes * page_bytes + last % page_content_bytes + 1};
  if (part.end > file.size())
    throw Error(std::string(what) + " of " + std::to_string(content_bytes) + " bytes goes beyond the file's end",
                file.at_byte(begin), damaged);
  return part;
}

std::string read_e57_content(const InputFile& file, const E57Part& part, std::string_view what) {
  E57PageCheck(file, part).rest();
  std::string content;
  content.reserve(content_before(part.end) - content_before(part.begin));
  for (std::uint64_t at = part.begin; at < part.end;) {
    const std::uint64_t page_end = at / page_bytes * page_bytes + page_content_bytes;
    const std::uint64_t take = std::min(page_end, part.end) - at;
    const std::size_t before = content.size();
    content.resize(before + take);
    file.read(at, reinterpret_cast<std::byte*>(content.data()) + before, take, what);
    at = page_end + (page_bytes - page_content_bytes);
  }
  return content;
}

E57Part e57_records_part(const InputFile& file, std::uint64_t begin) {
  const std::string_view what = "the points' section";
  const std::string header = read_e57_content(file, e57_part(file, begin, section_header_bytes, what), what);
  const auto* bytes = reinterpret_cast<const std::byte*>(header.data());
  if (bytes[0] != section_of_records)
    throw Error("no section with points begins here, as the XML says", file.at_byte(begin), damaged);
  return e57_part(file, begin, little<std::uint64_t>(bytes + 8), what);
}

E57PageCheck::E57PageCheck(const InputFile& file, const E57Part& part)
    : file_(file), part_(part), next_(part.begin / page_bytes * page_bytes) {}

void E57PageCheck::ahead_of(double share) {
  const std::uint64_t bytes = part_.end - part_.begin;
  const auto passed = static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(bytes));
  up_to(part_.begin + std::min(bytes, passed + margin_bytes));
}

void E57PageCheck::rest() {
  up_to(part_.end);
}

void E57PageCheck::up_to(std::uint64_t end) {
  while (next_ < end) {
    const std::uint64_t pages = std::min<std::uint64_t>((end - next_ + page_bytes - 1) / page_bytes, pages_at_once);
    buffer_.resize(std::max(buffer_.size(), static_cast<std::size_t>(pages * page_bytes)));
    file_.read(next_, buffer_.data(), pages * page_bytes, "a page of the E57 file");
    for (std::uint64_t page = 0; page < pages; ++page, next_ += page_bytes)
      if (!is_whole(buffer_.data() + page * page_bytes))
        throw Error("a checksum of the file is wrong", file_.at_byte(next_), damaged);
  }
}

}  // namespace adit::io
