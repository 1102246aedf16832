#include <bit>
#include <cmath>
#include <cstring>

#include "io/atomic_file.h"
#include "io/intensity_range.h"
#include "io/las.h"
#include "io/las_grid.h"

namespace adit::io {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS files are written as memory holds the numbers");

constexpr std::size_t header_bytes = 375;

template <typename T>
void put(std::string& bytes, std::size_t offset, T value) {
  std::memcpy(bytes.data() + offset, &value, sizeof(T));
}

std::string header_of(const ScanFacts& scan, const LasGrid& grid) {
  const bool colour = scan.header.attributes.colour;
  std::string bytes(header_bytes, '\0');
  std::memcpy(bytes.data(), "LASF", 4);
  put<std::uint16_t>(bytes, 6, 16);  // coordinate system, if any, as well-known text: point formats 6 and up ask for it
  put<std::uint8_t>(bytes, 24, 1);
  put<std::uint8_t>(bytes, 25, 4);
  std::memcpy(bytes.data() + 26, "OTHER", 5);
  std::memcpy(bytes.data() + 58, "Adit", 4);
  put<std::uint16_t>(bytes, 94, header_bytes);
  put<std::uint32_t>(bytes, 96, header_bytes);
  put<std::uint8_t>(bytes, 104, colour ? 7 : 6);
  put<std::uint16_t>(bytes, 105, colour ? 36 : 30);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    put(bytes, 131 + 8 * axis, grid.scale_m);
    put(bytes, 155 + 8 * axis, grid.offset[k]);
    put(bytes, 179 + 16 * axis, grid.rounded(scan.box.max())[k]);  // the box of the points as they are stored
    put(bytes, 187 + 16 * axis, grid.rounded(scan.box.min())[k]);
  }
  put<std::uint64_t>(bytes, 247, scan.points);
  put<std::uint64_t>(bytes, 255, scan.points);  // all of them first returns
  return bytes;
}

class LasWriter : public ScanWriter {
 public:
  LasWriter(const std::filesystem::path& path, const ScanFacts& scan)
      : scan_(scan),
        grid_(las_grid(scan.box)),
        range_(intensity_range(scan, 65535.0, true)),
        file_(path),
        record_(scan.header.attributes.colour ? 36 : 30, '\0') {}

  bool begin(const ScanHeader&) override {
    file_.append(header_of(scan_, grid_));
    return true;
  }

  void take(PointBlock& block) override {
    for (std::size_t i = 0; i < block.size(); ++i) {
      fill_record(block, i);
      file_.append(record_);
    }
  }

  void end(std::uint64_t) override {}
  void commit() override { file_.commit(); }

 private:
  void fill_record(const PointBlock& block, std::size_t i) {
    const auto steps = grid_.steps(block.positions[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) put(record_, 4 * axis, steps[axis]);
    if (!block.intensity.empty()) put(record_, 12, static_cast<std::uint16_t>(std::lround(range_(block.intensity[i]))));
    put<std::uint8_t>(record_, 14, 0x11);  // first return of one
    if (block.colour.empty()) return;
    for (std::size_t c = 0; c < 3; ++c) put(record_, 30 + 2 * c, static_cast<std::uint16_t>(block.colour[i][c] * 257U));
  }

  ScanFacts scan_;
  LasGrid grid_;
  IntensityRange range_;
  AtomicFile file_;
  std::string record_;
};

}  // namespace

std::unique_ptr<ScanWriter> make_las_writer(const std::filesystem::path& path, const std::vector<ScanFacts>& scans,
                                            const WriteOptions&) {
  return std::make_unique<LasWriter>(path, scans.at(0));
}

}  // namespace adit::io
