#include "io/atomic_file.h"
#include "io/pts.h"
#include "io/text_row.h"

namespace adit::io {
namespace {

class PtsWriter : public ScanWriter {
 public:
  PtsWriter(const std::filesystem::path& path, const ScanFacts& scan) : scan_(scan), file_(path) {}

  bool begin(const ScanHeader&) override {
    file_.append(std::to_string(scan_.points) + "\n");
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      line_.clear();
      add_position(line_, block.positions[i], scan_.coordinates_are_float32);
      if (!block.intensity.empty()) line_.add(block.intensity[i]);
      if (!block.colour.empty()) add_colour(line_, block.colour[i]);
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

std::unique_ptr<ScanWriter> make_pts_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions&) {
  return std::make_unique<PtsWriter>(path, scans.at(0));
}

}  // namespace adit::io
