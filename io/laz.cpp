#include "io/laz.h"

#include "io/las.h"
#include "io/las_header.h"
#include "io/laz_packing.h"

namespace adit::io {

bool is_laz(std::string_view beginning) {
  constexpr std::size_t point_format = 104;
  return is_las(beginning) && beginning.size() > point_format &&
         (static_cast<unsigned char>(beginning[point_format]) & 0xC0U) != 0;
}

ScanFileSummary summarise_laz(const std::filesystem::path& path, Progress&) {
  const InputFile file(path);
  const LasHeader header = read_las_header(file, LasPoints::compressed);
  read_laz_packing(file, header);
  return las_summary(file, header, "LAZ");
}

}  // namespace adit::io
