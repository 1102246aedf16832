#pragma once
// A coded target fitted to the grey values of a picture: where it stands to parts of a pixel, and which code it shows.

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "core/geometry/grey_picture.h"
#include "core/georeference/coded_pattern.h"
#include "core/georeference/dark_blobs.h"

namespace adit {

/// The plane of a target in a picture: a place (x, y) of the pattern, in outer radii, is seen at
/// center + shape (x, y) / (1 + tilt . (x, y)). The centre is that of the circle in space, not of the ellipse it is
/// seen as: perspective sets them apart.
struct TargetPlace {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();     ///< pixels
  Eigen::Matrix2d shape = Eigen::Matrix2d::Identity();  ///< pixels for one outer radius
  Eigen::Vector2d tilt = Eigen::Vector2d::Zero();       ///< perspective: how the scale falls off over one outer radius

  Eigen::Vector2d pixel(const Eigen::Vector2d& at) const { return center + shape * at / (1.0 + tilt.dot(at)); }
};

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
};

/// What may be read.
struct TargetFitOptions {
  std::vector<TargetCode>
      codes;  ///< that were printed; empty: any of target_codes(), and then not a single doubtful segment
  double focal_length_px = 0.0;  ///< how strong perspective may be; 0: the longer side of the picture
};

/// The target whose centre disc a blob may be, as disc and white ring around it show it.
struct TargetStart {
  TargetPlace place;  ///< without perspective
  double blur_px = 0.0;
  double likeness = -1.0;  ///< correlation of picture, disc and white ring; -1 where there is none
};

/// The blob's moments give the disc up to a rotation: the ones that look best are adjusted to the picture, and the one
/// that fits best then is it.
TargetStart target_start(const GreyPicture& picture, const DarkBlob& blob);

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
