#pragma once
// Pictures of cameras: files to shades of grey.

#include <filesystem>
#include <optional>
#include <string>

#include "core/geometry/grey_picture.h"
#include "core/georeference/camera_lens.h"

namespace adit::io {

/// PNG, JPEG, TIFF, BMP, PGM; colours and 16 bits become 8 bits of grey. A note of how the camera was held is passed
/// over. Throws Error for what is no picture or damaged.
GreyPicture read_grey_picture(const std::filesystem::path& path);

/// The same of a known camera. Throws Error, too, where the picture is not of the camera's size.
GreyPicture read_grey_picture(const std::filesystem::path& path, const std::optional<CameraLens>& lens);

/// The bytes of a PNG.
std::string png_of(const GreyPicture& picture);

}  // namespace adit::io
