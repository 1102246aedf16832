#pragma once
// Pictures of cameras: files to shades of grey.

#include <filesystem>
#include <string>

#include "core/geometry/grey_picture.h"

namespace adit::io {

/// PNG, JPEG, TIFF, BMP, PGM; colours and 16 bits become 8 bits of grey. A note of how the camera was held is passed
/// over. Throws Error for what is no picture or damaged.
GreyPicture read_grey_picture(const std::filesystem::path& path);

/// The bytes of a PNG.
std::string png_of(const GreyPicture& picture);

}  // namespace adit::io
