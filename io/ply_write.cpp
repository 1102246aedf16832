#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/ply.h"
#include "io/text_row.h"

namespace adit::io {
namespace {

std::string header_text(const ScanFacts& scan, const std::string& encoding) {
  const std::string coordinate = scan.coordinates_are_float32 ? "property float " : "property double ";
  const Attributes& has = scan.header.attributes;
  std::string text = "ply\nformat " + encoding + " 1.0\ncomment written by Adit, metres\nelement vertex " +
                     std::to_string(scan.points) + "\n";
  for (const char* axis : {"x", "y", "z"}) text += coordinate + axis + "\n";
  if (has.intensity) text += "property float intensity\n";
  if (has.colour) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (has.normals) text += "property float nx\nproperty float ny\nproperty float nz\n";
  return text + "end_header\n";
}

class PlyWriter : public ScanWriter {
 public:
  PlyWriter(const std::filesystem::path& path, const ScanFacts& scan, const std::string& variant)
      : scan_(scan),
        ascii_(variant == "ascii"),
        order_(variant == "big" ? std::endian::big : std::endian::little),
        file_(path) {}

  bool begin(const ScanHeader&) override {
    file_.append(header_text(scan_, ascii_                       ? "ascii"
                                    : order_ == std::endian::big ? "binary_big_endian"
                                                                 : "binary_little_endian"));
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (ascii_)
        append_text(block, i);
      else
        append_binary(block, i);
    }
  }

  void end(std::uint64_t) override {}
  void commit() override { file_.commit(); }

 private:
  void append_binary(const PointBlock& block, std::size_t i) {
    row_.clear();
    for (const double c : block.positions[i]) {
      if (scan_.coordinates_are_float32)
        append_stored(row_, static_cast<float>(c), order_);
      else
        append_stored(row_, c, order_);
    }
    const Attributes& has = scan_.header.attributes;
    if (has.intensity) append_stored(row_, block.intensity[i], order_);
    if (has.colour)
      for (const std::uint8_t c : block.colour[i]) append_stored(row_, c, order_);
    if (has.normals)
      for (const float c : block.normals[i]) append_stored(row_, c, order_);
    file_.append(row_);
  }

  void append_text(const PointBlock& block, std::size_t i) {
    line_.clear();
    add_position(line_, block.positions[i], scan_.coordinates_are_float32);
    const Attributes& has = scan_.header.attributes;
    if (has.intensity) line_.add(block.intensity[i]);
    if (has.colour) add_colour(line_, block.colour[i]);
    if (has.normals) add_normal(line_, block.normals[i]);
    file_.append(line_.ended());
  }

  ScanFacts scan_;
  bool ascii_;
  std::endian order_;
  AtomicFile file_;
  std::string row_;
  TextLine line_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_ply_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions& options) {
  return std::make_unique<PlyWriter>(path, scans.at(0), options.variant);
}

}  // namespace adit::io
