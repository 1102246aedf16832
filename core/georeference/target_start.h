#pragma once
// From a dark patch of a picture to the centre disc of a coded target.

#include "core/geometry/grey_picture.h"
#include "core/georeference/dark_blobs.h"
#include "core/georeference/target_place.h"

namespace adit {

/// The target whose centre disc a patch may be, as disc and white ring around it show it.
struct TargetStart {
  TargetPlace place;  ///< without perspective
  double blur_px = 0.0;
  double likeness = -1.0;  ///< correlation of picture, disc and white ring; -1 where there is none
};

/// The patch's moments give the disc up to a rotation: the ones that look best are adjusted to the picture, and the one
/// that fits best then is it.
TargetStart target_start(const GreyPicture& picture, const DarkBlob& blob);

/// Another one near it, adjusted from more blur.
TargetStart softer_start(const GreyPicture& picture, const TargetStart& start);

}  // namespace adit
