#include <laszip/laszip_api.h>

#include <string>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/las.h"
#include "io/las_header.h"
#include "io/laz.h"
#include "io/laz_packing.h"
#include "io/point_stream.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;

/// LASzip's reader of one file.
class Reader {
 public:
  /// wanted: which attributes are unpacked where each has a layer of its own.
  Reader(const std::filesystem::path& path, laszip_U32 wanted) : name_(path.string()) {
    if (laszip_create(&reader_) != 0) throw Error("LASzip cannot begin", name_, "free some memory");
    laszip_BOOL compressed = 0;
    if (laszip_decompress_selective(reader_, wanted) != 0 ||
        laszip_open_reader(reader_, name_.c_str(), &compressed) != 0 ||
        laszip_get_point_pointer(reader_, &point_) != 0) {
      const std::string words = said();
      laszip_destroy(reader_);
      throw Error("LASzip refuses the file: " + words, name_, "export it again");
    }
  }
  ~Reader() {
    laszip_close_reader(reader_);
    laszip_destroy(reader_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next point; i: how many were read before, for messages.
  const laszip_point& next(std::uint64_t i) {
    if (laszip_read_point(reader_) != 0)
      throw Error("LASzip cannot unpack it (" + said() + ")", name_ + ": point " + std::to_string(i + 1),
                  "the file is damaged; copy or export it again");
    return *point_;
  }

 private:
  std::string said() const {
    laszip_CHAR* words = nullptr;
    laszip_get_error(reader_, &words);
    return words != nullptr ? words : "no reason given";
  }

  std::string name_;
  laszip_POINTER reader_ = nullptr;
  laszip_point* point_ = nullptr;
};

constexpr laszip_U32 coordinates = laszip_DECOMPRESS_SELECTIVE_CHANNEL_RETURNS_XY | laszip_DECOMPRESS_SELECTIVE_Z;
constexpr laszip_U32 colours = laszip_DECOMPRESS_SELECTIVE_RGB;
constexpr laszip_U32 intensities = laszip_DECOMPRESS_SELECTIVE_INTENSITY;

/// Colours should fill 16 bits, but many files hold plain bytes. One value over 255 tells, and it comes early as a
/// rule.
bool colours_fill_16_bits(const std::filesystem::path& path, const LasHeader& header, const Progress& progress) {
  Reader reader(path, colours);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.check();
    const laszip_point& point = reader.next(i);
    if (point.rgb[0] > 255 || point.rgb[1] > 255 || point.rgb[2] > 255) return true;
  }
  return false;
}

}  // namespace

bool laz_is_built_in() {
  return true;
}

void stream_laz(const std::filesystem::path& path, const ReadOptions& options, ScanSink& sink, Progress& progress) {
  const InputFile file(path);
  const LasHeader header = read_las_header(file, LasPoints::compressed);
  read_laz_packing(file, header);
  const Attributes has = las_attributes(header);
  PointStream out({path.stem().string(), file.name(), has, std::nullopt, header.points, header.box}, options,
                  NanMeans::invalid, sink);
  if (!out.wanted()) return;
  const int shift = has.colour && colours_fill_16_bits(path, header, progress) ? 8 : 0;
  Reader reader(path, coordinates | intensities | (has.colour ? colours : 0));
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(i, header.points);
    const laszip_point& read = reader.next(i);
    point.position = Eigen::Vector3d(read.X, read.Y, read.Z).cwiseProduct(header.scale) + header.offset;
    point.intensity = static_cast<float>(read.intensity);
    for (std::size_t c = 0; c < 3; ++c) point.colour[c] = static_cast<std::uint8_t>(read.rgb[c] >> shift);
    out.add(point, [&] { return file.name() + ": point " + std::to_string(i + 1); });
  }
  out.end();
}

}  // namespace adit::io
