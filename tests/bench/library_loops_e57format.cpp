#include <E57Format.h>

#include <vector>

#include "tests/bench/library_loops.h"

namespace adit::bench {

std::uint64_t decode_e57(const std::filesystem::path& path) {
  constexpr std::size_t block = 65536;
  const e57::ImageFile file(path.string(), "r");
  const e57::VectorNode scans(file.root().get("data3D"));
  std::uint64_t points = 0;
  for (std::int64_t i = 0; i < scans.childCount(); ++i) {
    e57::CompressedVectorNode records(e57::StructureNode(scans.get(i)).get("points"));
    const e57::StructureNode record(records.prototype());
    std::vector<std::vector<double>> columns;
    std::vector<e57::SourceDestBuffer> buffers;
    for (const char* name :
         {"cartesianX", "cartesianY", "cartesianZ", "intensity", "colorRed", "colorGreen", "colorBlue"}) {
      if (!record.isDefined(name)) continue;
      columns.emplace_back(block);
      buffers.emplace_back(file, name, columns.back().data(), block, true, true);
    }
    e57::CompressedVectorReader reader = records.reader(buffers);
    while (const unsigned n = reader.read()) points += n;
  }
  return points;
}

}  // namespace adit::bench
