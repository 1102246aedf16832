#pragma once
// A scan's normal distributions from above, as a picture.

#include <string>

#include "core/registration/probability_image.h"
#include "render/picture.h"

namespace adit::render {

/// One pixel for one of the image's, brighter where points are likelier (black, blue, orange, white: the root of the
/// density, full at its 99th percentile), north up, a scale bar and words beneath.
Picture probability_picture(const ProbabilityImage& image, const std::string& words);

}  // namespace adit::render
