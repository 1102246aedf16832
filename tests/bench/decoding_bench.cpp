// The libraries' own decoding loops over E57 and LAZ files: the peers of the import.

#include <cstdio>
#include <vector>

#include "core/foundation/error.h"
#include "tests/bench/bench.h"
#ifdef ADIT_BENCH_E57
#include <E57Format.h>
#endif
#ifdef ADIT_BENCH_LAZ
#include <laszip/laszip_api.h>
#endif

namespace adit::bench {
namespace {

/// Coordinates and intensity of every scan, in buffers of 65,536 records.
std::uint64_t decoded_e57([[maybe_unused]] const std::string& name) {
  std::uint64_t points = 0;
#ifdef ADIT_BENCH_E57
  constexpr std::size_t records = 65536;
  e57::ImageFile file(name, "r");
  const e57::VectorNode scans(file.root().get("data3D"));
  for (std::int64_t k = 0; k < scans.childCount(); ++k) {
    e57::CompressedVectorNode vector(e57::StructureNode(scans.get(k)).get("points"));
    std::vector<std::vector<double>> columns;
    std::vector<e57::SourceDestBuffer> buffers;
    for (const char* field : {"cartesianX", "cartesianY", "cartesianZ", "intensity"}) {
      columns.emplace_back(records);
      buffers.emplace_back(file, field, columns.back().data(), records, true, true);
    }
    e57::CompressedVectorReader reader = vector.reader(buffers);
    while (const unsigned got = reader.read()) points += got;
  }
#endif
  return points;
}

std::uint64_t decoded_laz([[maybe_unused]] const std::string& name) {
  laszip_I64 points = 0;
#ifdef ADIT_BENCH_LAZ
  laszip_POINTER reader = nullptr;
  laszip_BOOL compressed = 0;
  laszip_point* point = nullptr;
  laszip_header* header = nullptr;
  if (laszip_create(&reader) != 0 || laszip_open_reader(reader, name.c_str(), &compressed) != 0 ||
      laszip_get_header_pointer(reader, &header) != 0 || laszip_get_point_pointer(reader, &point) != 0)
    throw Error("LASzip refuses the file", name, "look at it with adit info");
  const laszip_I64 count = header->number_of_point_records > 0
                               ? static_cast<laszip_I64>(header->number_of_point_records)
                               : static_cast<laszip_I64>(header->extended_number_of_point_records);
  while (points < count && laszip_read_point(reader) == 0) ++points;
  laszip_close_reader(reader);
  laszip_destroy(reader);
#endif
  return static_cast<std::uint64_t>(points);
}

}  // namespace

void bench_decoding(const std::string& file) {
  std::uint64_t points = 0;
  const double seconds =
      seconds_of(1, [&] { points = file.ends_with(".e57") ? decoded_e57(file) : decoded_laz(file); });
  if (points == 0) throw Error("nothing was decoded: the library is not built in", file, "run packaging/setup");
  std::printf("| %.1f | %.2f |\n", static_cast<double>(points) / 1e6, static_cast<double>(points) / 1e6 / seconds);
}

}  // namespace adit::bench
