#include <laszip/laszip_api.h>

#include <array>
#include <cmath>
#include <cstring>
#include <ostream>
#include <string>

#include "core/foundation/error.h"
#include "io/atomic_file.h"
#include "io/bytes.h"
#include "io/deferred_output.h"
#include "io/intensity_range.h"
#include "io/las_grid.h"
#include "io/las_header.h"
#include "io/laz.h"
#include "io/laz_packing.h"

namespace adit::io {
namespace {

laszip_header header_of(const ScanFacts& facts, const LasGrid& grid) {
  laszip_header header{};
  header.global_encoding = 16;  // coordinate system, if any, as well-known text: point formats 6 and up ask for it
  header.version_major = 1;
  header.version_minor = 4;
  std::memcpy(header.system_identifier, "OTHER", 5);
  std::memcpy(header.generating_software, "Adit", 4);
  header.header_size = 375;
  header.offset_to_point_data = 375;
  header.point_data_format = facts.header.attributes.colour ? 7 : 6;
  header.point_data_record_length = facts.header.attributes.colour ? 36 : 30;
  header.x_scale_factor = header.y_scale_factor = header.z_scale_factor = grid.scale_m;
  header.x_offset = grid.offset.x();
  header.y_offset = grid.offset.y();
  header.z_offset = grid.offset.z();
  header.extended_number_of_point_records = facts.points;
  return header;  // box and returns are filled in by LASzip when it closes the file
}

/// LASzip's writer of one file under a temporary name.
class LazWriter : public ScanWriter {
 public:
  LazWriter(const std::filesystem::path& file, const ScanFacts& facts)
      : path_(file),
        facts_(facts),
        grid_(las_grid(facts.box)),
        intensity_(intensity_range(facts, 65535.0, true)),
        output_(path_.temporary()),
        stream_(&output_) {
    if (laszip_create(&writer_) != 0) throw Error("LASzip cannot begin", file.string(), "free some memory");
    const laszip_header header = header_of(facts, grid_);
    if (laszip_set_header(writer_, &header) != 0 || laszip_preserve_generating_software(writer_, 1) != 0 ||
        laszip_request_native_extension(writer_, 1) != 0 || laszip_open_writer_stream(writer_, stream_, 1, 0) != 0 ||
        laszip_get_point_pointer(writer_, &point_) != 0) {
      const std::string words = said();
      laszip_destroy(writer_);
      throw Error("LASzip cannot write it: " + words, file.string(), "check the folder and the disk");
    }
    point_->extended_point_type = 1;
    point_->extended_return_number = 1;
    point_->extended_number_of_returns = 1;
  }
  ~LazWriter() override {
    laszip_close_writer(writer_);
    laszip_destroy(writer_);
  }

  bool begin(const ScanHeader&) override { return true; }

  void take(PointBlock& block) override {
    const Attributes& has = facts_.header.attributes;
    const std::array<laszip_I32*, 3> steps{&point_->X, &point_->Y, &point_->Z};
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto at = grid_.steps(block.positions[i]);
      for (std::size_t k = 0; k < 3; ++k) *steps[k] = at[k];
      if (has.intensity) point_->intensity = static_cast<laszip_U16>(std::lround(intensity_(block.intensity[i])));
      for (std::size_t c = 0; has.colour && c < 3; ++c)
        point_->rgb[c] = static_cast<laszip_U16>(block.colour[i][c] * 257U);
      if (laszip_write_point(writer_) != 0 || laszip_update_inventory(writer_) != 0) fail();
    }
    if (output_.error() != 0) path_.fail("the file cannot be written", output_.error());
  }

  void end(std::uint64_t) override {}

  void commit() override {
    if (laszip_close_writer(writer_) != 0) fail();
    if (const int error = output_.flushed_error(); error != 0) path_.fail("the file cannot be written", error);
    expect_whole();
    path_.commit();
  }

 private:
  std::string said() const {
    laszip_CHAR* words = nullptr;
    laszip_get_error(writer_, &words);
    return words != nullptr ? words : "no reason given";
  }
  [[noreturn]] void fail() const {
    throw Error("the file cannot be written (LASzip: " + said() + ")", path_.target().string(),
                "free some space or write to another disk");
  }
  /// As far as the chunks of points tell.
  void expect_whole() const {
    try {
      const InputFile file(path_.temporary());
      const LasHeader header = read_las_header(file, LasPoints::compressed);
      if (header.points == facts_.points) {
        read_laz_packing(file, header);
        return;
      }
    } catch (const Error&) {  // said below, under the file's own name
    }
    throw Error("the file was not written whole", path_.target().string(), "free some space or write to another disk");
  }

  AtomicPath path_;
  ScanFacts facts_;
  LasGrid grid_;
  IntensityRange intensity_;
  DeferredOutput output_;  ///< LASzip crashes where its bytes find no room
  std::ostream stream_;
  laszip_POINTER writer_ = nullptr;
  laszip_point* point_ = nullptr;
};

}  // namespace

std::unique_ptr<ScanWriter> make_laz_writer(const std::filesystem::path& file, const std::vector<ScanFacts>& scans,
                                            const WriteOptions&) {
  return std::make_unique<LazWriter>(file, scans.at(0));
}

}  // namespace adit::io
