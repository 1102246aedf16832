#include "io/atomic_file.h"
#include "io/text_row.h"
#include "io/xyz.h"

namespace adit::io {
namespace {

class XyzWriter : public ScanWriter {
 public:
  XyzWriter(const std::filesystem::path& path, const ScanFacts& scan)
      : scan_(scan), file_(path), line_(path.extension() == ".csv" ? ',' : ' ') {}

  bool begin(const ScanHeader&) override {
    const Attributes& has = scan_.header.attributes;
    line_.clear();
    line_.add("x").add("y").add("z");
    if (has.intensity) line_.add("intensity");
    if (has.colour) line_.add("r").add("g").add("b");
    if (has.normals) line_.add("nx").add("ny").add("nz");
    file_.append(line_.ended());
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      line_.clear();
      add_position(line_, block.positions[i], scan_.coordinates_are_float32);
      if (!block.intensity.empty()) line_.add(block.intensity[i]);
      if (!block.colour.empty()) add_colour(line_, block.colour[i]);
      if (!block.normals.empty()) add_normal(line_, block.normals[i]);
      file_.append(line_.ended());
    }
  }

  void end(std::uint64_t) override {}
  void commit() override { file_.commit(); }

 private:
  ScanFacts scan_;
  AtomicFile file_;
  TextLine line_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_xyz_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions&) {
  return std::make_unique<XyzWriter>(path, scans.at(0));
}

}  // namespace adit::io
