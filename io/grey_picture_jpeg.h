#pragma once
// JPEG pictures: a damaged one is refused, where decoders go on with what they guess.

#include <string>

#include "core/geometry/grey_picture.h"

namespace adit::io {

bool is_jpeg(const std::string& bytes);

/// As the sensor saw it, however the camera was held. Throws Error for anything that a decoder would warn of; `file`
/// is named there.
GreyPicture grey_of_jpeg(const std::string& bytes, const std::string& file);

}  // namespace adit::io
