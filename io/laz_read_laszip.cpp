#include <laszip/laszip_api.h>

#include <cstring>
#include <optional>
#include <sstream>
#include <string>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/las.h"
#include "io/las_description.h"
#include "io/las_header.h"
#include "io/laz.h"
#include "io/laz_packing.h"
#include "io/point_stream.h"

namespace adit::io {
namespace {

constexpr std::uint64_t points_between_checks = 8192;

/// LASzip's reader of a file, or of the bytes of one.
class Reader {
 public:
  /// wanted: which attributes are unpacked where each has a layer of its own.
  Reader(const std::string& name, laszip_U32 wanted) : name_(name) {
    begin(wanted, [&](laszip_BOOL* compressed) { return laszip_open_reader(reader_, name_.c_str(), compressed); });
  }
  Reader(const std::string& name, const std::string& bytes, laszip_U32 wanted) : name_(name), bytes_(bytes) {
    begin(wanted, [&](laszip_BOOL* compressed) { return laszip_open_reader_stream(reader_, bytes_, compressed); });
  }
  ~Reader() {
    laszip_close_reader(reader_);
    laszip_destroy(reader_);
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// The next point; i: how many of the file were read before, for messages.
  const laszip_point& next(std::uint64_t i) {
    if (laszip_read_point(reader_) != 0)
      throw Error("LASzip cannot unpack it (" + said() + ")", name_ + ": point " + std::to_string(i + 1),
                  "the file is damaged; copy or export it again");
    return *point_;
  }

 private:
  template <typename Open>
  void begin(laszip_U32 wanted, const Open& open) {
    if (laszip_create(&reader_) != 0) throw Error("LASzip cannot begin", name_, "free some memory");
    laszip_BOOL compressed = 0;
    if (laszip_decompress_selective(reader_, wanted) == 0 && open(&compressed) == 0 &&
        laszip_get_point_pointer(reader_, &point_) == 0)
      return;
    const std::string words = said();
    laszip_destroy(reader_);
    throw Error("LASzip refuses the file: " + words, name_, "export it again");
  }
  std::string said() const {
    laszip_CHAR* words = nullptr;
    laszip_get_error(reader_, &words);
    return words != nullptr ? words : "no reason given";
  }

  std::string name_;
  std::istringstream bytes_;
  laszip_POINTER reader_ = nullptr;
  laszip_point* point_ = nullptr;
};

/// The points of a file one after the other. Chunks of differing sizes are unpacked each as a file of its own: LASzip
/// would take their sizes from the chunk table, and go astray where that is damaged.
class Points {
 public:
  Points(const InputFile& file, const LasHeader& header, const LazPacking& packing, laszip_U32 wanted)
      : file_(file), packing_(packing), wanted_(wanted) {
    if (!packing.differing.empty()) return;
    left_ = header.points;
    reader_.emplace(file.name(), wanted);
  }

  /// Valid until the next call; not more often than the header has points.
  const laszip_point& next() {
    if (left_ == 0) begin_chunk();
    --left_;
    return reader_->next(read_++);
  }

 private:
  void begin_chunk() {
    const LazChunk& chunk = packing_.differing.at(next_chunk_++);
    left_ = chunk.points;
    reader_.emplace(file_.name(), file_of(chunk), wanted_);
  }

  /// Header, LASzip's record and the chunk, without a chunk table.
  std::string file_of(const LazChunk& chunk) const {
    constexpr std::uint32_t header_bytes = 375, record_head_bytes = 54;
    std::string bytes = file_.beginning(header_bytes);
    const auto add = [&](std::uint64_t begin, std::uint64_t count) {
      const std::vector<std::byte> part = file_.read(begin, count, "a chunk of points");
      bytes.append(reinterpret_cast<const char*>(part.data()), part.size());
    };
    const auto put = [&](std::size_t offset, const auto& value) { std::memcpy(&bytes[offset], &value, sizeof value); };
    add(packing_.record_offset - record_head_bytes, record_head_bytes + std::uint64_t{packing_.record_bytes});
    const std::uint64_t points_offset = bytes.size();
    put(94, static_cast<std::uint16_t>(header_bytes));
    put(96, static_cast<std::uint32_t>(points_offset));
    put(100, std::uint32_t{1});
    put(header_bytes + record_head_bytes + 12, static_cast<std::uint32_t>(chunk.points));
    bytes.append(reinterpret_cast<const char*>(&points_offset),
                 sizeof points_offset);  // as if cut short before the table
    add(chunk.begin, chunk.end - chunk.begin);
    return bytes;
  }

  const InputFile& file_;
  const LazPacking& packing_;
  laszip_U32 wanted_;
  std::optional<Reader> reader_;
  std::uint64_t left_ = 0;  ///< of the points that reader_ holds
  std::uint64_t read_ = 0;
  std::size_t next_chunk_ = 0;
};

constexpr laszip_U32 coordinates = laszip_DECOMPRESS_SELECTIVE_CHANNEL_RETURNS_XY | laszip_DECOMPRESS_SELECTIVE_Z;
constexpr laszip_U32 colours = laszip_DECOMPRESS_SELECTIVE_RGB;
constexpr laszip_U32 intensities = laszip_DECOMPRESS_SELECTIVE_INTENSITY;

/// Colours should fill 16 bits, but many files hold plain bytes. One value over 255 tells, and it comes early as a
/// rule.
bool colours_fill_16_bits(const InputFile& file, const LasHeader& header, const LazPacking& packing,
                          const Progress& progress) {
  Points points(file, header, packing, colours);
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.check();
    const laszip_point& point = points.next();
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
  const LazPacking packing = read_laz_packing(file, header);
  const Attributes has = options.positions_only ? Attributes{} : las_attributes(header);
  PointStream out(
      {path.stem().string(), file.name(), has, std::nullopt, header.points, header.box, las_unit(file, header)},
      options, NanMeans::invalid, sink);
  if (!out.wanted()) return;
  const int shift = has.colour && colours_fill_16_bits(file, header, packing, progress) ? 8 : 0;
  Points points(file, header, packing, coordinates | (has.intensity ? intensities : 0) | (has.colour ? colours : 0));
  FilePoint point;
  for (std::uint64_t i = 0; i < header.points; ++i) {
    if (i % points_between_checks == 0) progress.step(i, header.points);
    const laszip_point& read = points.next();
    point.position = Eigen::Vector3d(read.X, read.Y, read.Z).cwiseProduct(header.scale) + header.offset;
    point.intensity = static_cast<float>(read.intensity);
    for (std::size_t c = 0; c < 3; ++c) point.colour[c] = static_cast<std::uint8_t>(read.rgb[c] >> shift);
    out.add(point, [&] { return file.name() + ": point " + std::to_string(i + 1); });
  }
  out.end();
}

}  // namespace adit::io
