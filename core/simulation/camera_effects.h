#pragma once
// From what an ideal camera sees to what a real one stores: lens, blur, light, dust, glare, noise.

#include <cstdint>

#include "core/geometry/grey_picture.h"
#include "core/georeference/camera_lens.h"

namespace adit {

struct CameraEffects {
  std::uint64_t seed = 1;
  double exposure = 1.0;    ///< linear light 255 of the ideal picture becomes 255 times that
  double blur_px = 0.7;     ///< point spread, one sigma
  double vignetting = 0.3;  ///< share of light lost in the corners
  double gamma = 1.0;       ///< stored = 255 (light / 255)^(1 / gamma)
  double read_noise = 1.5;  ///< grey levels of linear light, one sigma
  double shot_noise = 0.5;  ///< grey levels at light 1, grows with its root
  int dust = 0;             ///< grains before the lens: bright discs out of focus
  int glare = 0;            ///< reflections: spots and streaks that are brighter than the picture can show
};

/// `ideal`: linear light by a pinhole with its principal point in the middle, `ideal_focal_px` pixels for a unit of the
/// plane z = 1; finer than the lens's own picture, and wide enough to hold what its distortion pulls in (black beyond).
GreyPicture stored_picture(const GreyPicture& ideal, double ideal_focal_px, const CameraLens& lens,
                           const CameraEffects& effects);

/// How many pixels wide and high the ideal picture must be, `finer` times the lens's.
struct IdealSize {
  int width = 0;
  int height = 0;
  double focal_px = 0.0;
};
IdealSize ideal_size(const CameraLens& lens, double finer);

}  // namespace adit
