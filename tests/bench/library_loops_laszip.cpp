#include <laszip/laszip_api.h>

#include "tests/bench/library_loops.h"

namespace adit::bench {

std::uint64_t decode_laz(const std::filesystem::path& path) {
  laszip_POINTER reader = nullptr;
  laszip_BOOL compressed = 0;
  laszip_header* header = nullptr;
  if (laszip_create(&reader) != 0 || laszip_open_reader(reader, path.c_str(), &compressed) != 0 ||
      laszip_get_header_pointer(reader, &header) != 0)
    return 0;
  const std::uint64_t points = header->extended_number_of_point_records;
  std::uint64_t read = 0;
  while (read < points && laszip_read_point(reader) == 0) ++read;
  laszip_close_reader(reader);
  laszip_destroy(reader);
  return read;
}

}  // namespace adit::bench
