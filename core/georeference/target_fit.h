#pragma once
// A coded target fitted to the grey values of a picture: where it stands to parts of a pixel, and which code it shows.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/geometry/grey_picture.h"
#include "core/georeference/coded_pattern.h"
#include "core/georeference/target_place.h"
#include "core/georeference/target_start.h"

namespace adit {

/// A target as it was read.
struct TargetReading {
  TargetCode code = 0;
  TargetPlace place;
  double blur_px = 0.0;   ///< standard deviation of the point spread
  double bleed = 0.0;     ///< how many of those white creeps over black
  double likeness = 0.0;  ///< correlation of picture and fitted pattern
  double margin = 0.0;    ///< how much worse the next code fits, in segments
  bool alone = false;     ///< no list of codes that differ speaks for this one, only what each segment shows
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  ///< of the centre
  double covered_px = 0.0;  ///< how far what hides parts of it may have pulled the centre, one sigma; in the covariance
};

/// What may be read.
struct TargetFitOptions {
  std::vector<TargetCode>
      codes;  ///< that were printed; empty: any of target_codes(), and then not a single doubtful segment
  double focal_length_px = 0.0;  ///< how strong perspective may be; 0: the longer side of the picture
};

/// The same reading adjusted to a finer picture of the same scene, in whose pixels it is given and returned; as it was
/// where that fails. Places along the edges count.
TargetReading finer_reading(const GreyPicture& picture, const TargetReading& reading, double focal_length_px);

/// True where light lies over some of the disc and the paper is as bright as the picture can be: there, a reflection
/// may hide black segments without a trace, so that another code shows.
bool reflection_on_disc(const GreyPicture& picture, const TargetReading& reading);

/// The target at a start; nothing where there is none, or it cannot be read without doubt. The segments'
/// darkness is solved for by least squares, blur and neighbours considered; then place, perspective, blur and
/// brightness are adjusted together on the whole pattern.
std::optional<TargetReading> read_target(const GreyPicture& picture, const TargetStart& start,
                                         const TargetFitOptions& options);

}  // namespace adit
