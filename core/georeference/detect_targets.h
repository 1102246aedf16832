#pragma once
// Coded targets in a picture.

#include <Eigen/Core>

#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/grey_picture.h"
#include "core/georeference/target_fit.h"

namespace adit {

/// A target that was found. Pixels, (0, 0) the centre of the first one.
struct DetectedTarget {
  int id = 0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< of the circle, not of its ellipse
  double diameter_px = 0.0;                          ///< of the segments' ring, where it is seen longest
  double sigma_px = 0.0;                             ///< one sigma of the centre, its worse direction
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();
  TargetReading reading;
};

struct DetectOptions {
  TargetFitOptions fit;
  double least_diameter_px = 16.0;
};

/// Every target of the picture, in order of id, then place; a target that is seen twice stands twice. Dark patches are
/// looked for in the picture and in smaller ones, each half the size of the one before, so that every disc is some
/// pixels wide in one of them; each is then read (read_target). The same picture gives the same targets on any number
/// of threads. Throws Error for a picture of fewer than 32 pixels a side.
std::vector<DetectedTarget> detect_targets(const GreyPicture& picture, const DetectOptions& options,
                                           Progress& progress);

}  // namespace adit
