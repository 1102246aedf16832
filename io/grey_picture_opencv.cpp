#include <algorithm>
#include <bit>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/grey_picture_file.h"
#include "io/grey_picture_jpeg.h"

namespace adit::io {
namespace {

/// What a TIFF says of how its picture is turned, 1 as it is stored; also where it says nothing.
int tiff_orientation(const std::string& bytes) {
  constexpr std::uint16_t orientation_tag = 274;
  constexpr std::size_t entry_bytes = 12;
  const bool little_end = bytes.rfind(std::string_view("II*\0", 4), 0) == 0;
  if (!little_end && bytes.rfind(std::string_view("MM\0*", 4), 0) != 0) return 1;
  const std::endian order = little_end ? std::endian::little : std::endian::big;
  const auto* at = reinterpret_cast<const std::byte*>(bytes.data());
  const auto short_at = [&](std::size_t i) { return stored_as<std::uint16_t>(order, at + i); };
  if (bytes.size() < 8) return 1;
  const std::size_t directory = stored_as<std::uint32_t>(order, at + 4);
  if (directory > bytes.size() || bytes.size() - directory < 2) return 1;
  const std::size_t entries = short_at(directory);
  for (std::size_t k = 0; k < entries; ++k) {
    const std::size_t entry = directory + 2 + entry_bytes * k;
    if (bytes.size() < entry + entry_bytes) return 1;
    if (short_at(entry) == orientation_tag) return short_at(entry + 8);
  }
  return 1;
}

/// OpenCV reads more, some of them in part.
bool is_known(std::string_view bytes) {
  using namespace std::string_view_literals;
  for (const std::string_view magic :
       {"\x89PNG"sv, "II*\0"sv, "MM\0*"sv, "BM"sv, "P1"sv, "P2"sv, "P3"sv, "P4"sv, "P5"sv, "P6"sv})
    if (bytes.substr(0, magic.size()) == magic) return true;
  return false;
}

/// By OpenCV, which knows the formats.
GreyPicture grey_of_any(const std::string& bytes, const std::string& file) {
  cv::Mat grey;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    if (is_known(bytes)) grey = cv::imdecode(raw, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    grey.release();
  }
  if (grey.empty())
    throw Error("this is no picture, or it is damaged", file, "name a PNG, JPEG, TIFF, BMP or PGM picture");
  GreyPicture picture(grey.cols, grey.rows);
  for (int v = 0; v < grey.rows; ++v)
    std::copy(grey.ptr<std::uint8_t>(v), grey.ptr<std::uint8_t>(v) + grey.cols,
              picture.pixels.data() + picture.index(0, v));
  return picture;
}

}  // namespace

GreyPicture read_grey_picture(const std::filesystem::path& path) {
  constexpr std::uint64_t largest_file = std::uint64_t{1} << 29;
  constexpr int longest_side = 40000;
  const InputFile file(path);
  if (file.size() == 0) throw Error("the file is empty", file.name(), "name a PNG, JPEG, TIFF, BMP or PGM picture");
  if (file.size() > largest_file)
    throw Error("the file is larger than 512 MiB", file.name(), "name a PNG, JPEG, TIFF, BMP or PGM picture");
  const std::string bytes = file.beginning(static_cast<std::size_t>(file.size()));
  if (tiff_orientation(bytes) > 1)
    throw Error("the TIFF says that its picture is to be turned, which the calibration of the camera does not know of",
                file.name(), "save it without an orientation, as the sensor saw it");
  GreyPicture picture = is_jpeg(bytes) ? grey_of_jpeg(bytes, file.name()) : grey_of_any(bytes, file.name());
  if (picture.width > longest_side || picture.height > longest_side)
    throw Error("the picture is " + std::to_string(picture.width) + " x " + std::to_string(picture.height) + " pixels",
                file.name(), "use the camera's own pictures, up to 40000 pixels a side");
  return picture;
}

GreyPicture read_grey_picture(const std::filesystem::path& path, const std::optional<CameraLens>& lens) {
  GreyPicture picture = read_grey_picture(path);
  if (lens && (picture.width != lens->width || picture.height != lens->height))
    throw Error("the picture has " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                    " pixels, the camera file is for " + std::to_string(lens->width) + " x " +
                    std::to_string(lens->height),
                path.string(), "name the file of the camera that took it, at this size");
  return picture;
}

std::string png_of(const GreyPicture& picture) {
  std::vector<unsigned char> bytes;
  const cv::Mat grey(picture.height, picture.width, CV_8U, const_cast<std::uint8_t*>(picture.pixels.data()));
  cv::imencode(".png", grey, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace adit::io
