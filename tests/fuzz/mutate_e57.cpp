// What the fuzzer makes of an E57 file would fail at the first checksum. This puts the checksums right again, and most
// times the header as well, so that the reader behind them is tried.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "tests/io/e57_pages.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace adit;

constexpr std::size_t header_bytes = 48;

/// Where the XML is and how long the file, as the content shows it.
void put_header_right(std::string& content) {
  const std::size_t begin = content.rfind("<?xml");
  const std::size_t end = content.rfind('>');
  if (begin != std::string::npos && end != std::string::npos && end > begin) {
    tests::put_number(content, 24, begin / tests::e57_content * tests::e57_page + begin % tests::e57_content);
    tests::put_number(content, 32, end + 1 - begin);
  }
  const std::size_t pages = (content.size() + tests::e57_content - 1) / tests::e57_content;
  tests::put_number(content, 16, pages * tests::e57_page);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  const std::size_t pages = most / tests::e57_page;
  if (pages == 0) return LLVMFuzzerMutate(data, size, most);
  std::string content = tests::without_checksums({reinterpret_cast<const char*>(data), size});
  const std::size_t before = std::min(content.size(), pages * tests::e57_content);
  content.resize(pages * tests::e57_content);
  content.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(content.data()), before, content.size()));
  if (seed % 8 != 0 && content.size() >= header_bytes) put_header_right(content);
  const std::string file = tests::with_checksums(content);
  std::memcpy(data, file.data(), file.size());
  return file.size();
}
