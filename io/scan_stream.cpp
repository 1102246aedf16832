#include "io/scan_stream.h"

#include "core/foundation/error.h"

namespace adit::io {

std::vector<std::string> attribute_names(const Attributes& attributes) {
  std::vector<std::string> names;
  if (attributes.intensity) names.emplace_back("intensity");
  if (attributes.colour) names.emplace_back("colour");
  if (attributes.normals) names.emplace_back("normals");
  if (attributes.grid) names.emplace_back("grid");
  return names;
}

std::string name_of_scan(const std::filesystem::path& file, int n) {
  return file.stem().string() + (n > 1 ? "-" + std::to_string(n) : "");
}

void expect_metres(const ScanHeader& scan) {
  if (scan.unit.empty()) return;
  throw Error("the file says that its coordinates are no metres (" + scan.unit + ")", scan.where,
              "export it in a system with metres in plan and height");
}

void PointBlock::clear() {
  positions.clear();
  intensity.clear();
  colour.clear();
  normals.clear();
  grid.clear();
}

}  // namespace adit::io
