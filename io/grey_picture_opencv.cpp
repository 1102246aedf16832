#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/foundation/error.h"
#include "io/bytes.h"
#include "io/grey_picture_file.h"

namespace adit::io {

GreyPicture read_grey_picture(const std::filesystem::path& path) {
  constexpr std::uint64_t largest_file = std::uint64_t{1} << 29;
  constexpr int longest_side = 40000;
  const InputFile file(path);
  if (file.size() == 0) throw Error("the file is empty", file.name(), "name a PNG, JPEG, TIFF, BMP or PGM picture");
  if (file.size() > largest_file)
    throw Error("the file is larger than 512 MiB", file.name(), "name a PNG, JPEG, TIFF, BMP or PGM picture");
  const std::string bytes = file.beginning(static_cast<std::size_t>(file.size()));
  cv::Mat grey;
  try {
    const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    // The sensor's own pixels, whichever way the camera was held: the calibration is of those.
    grey = cv::imdecode(raw, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception&) {
    grey.release();
  }
  if (grey.empty())
    throw Error("this is no picture, or it is damaged", file.name(), "name a PNG, JPEG, TIFF, BMP or PGM picture");
  if (grey.cols > longest_side || grey.rows > longest_side)
    throw Error("the picture is " + std::to_string(grey.cols) + " x " + std::to_string(grey.rows) + " pixels",
                file.name(), "use the camera's own pictures, up to 40000 pixels a side");
  GreyPicture picture(grey.cols, grey.rows);
  for (int v = 0; v < grey.rows; ++v)
    std::copy(grey.ptr<std::uint8_t>(v), grey.ptr<std::uint8_t>(v) + grey.cols,
              picture.pixels.data() + picture.index(0, v));
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
