#pragma once
// Targets of four quarters, black and white by turns, in a picture.

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/grey_picture.h"

namespace adit {

/// Two straight edges that cross: straight they stay under any tilt, so that their crossing is the centre.
struct FoundQuarters {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();          ///< pixel
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  ///< of the centre
  Eigen::Vector2d edge[2];                                   ///< unit directions of both edges
  double radius_px = 0.0;  ///< within which the picture shows black and white quarters
  double likeness = 0.0;   ///< correlation there
  double contrast = 0.0;   ///< grey levels from black to white
};

/// Places where a ring of 5 pixels is bright, dark, bright and dark by turns (ChESS, Bennett and Lasenby 2014), each
/// adjusted: crossing, both directions, blur, black and white. The radius grows as long as the picture keeps to the
/// pattern. Those within which fewer than 6 pixels do are left out.
/// sample_of: what was measured in a pixel, if anything, to adjust them to; empty: its grey value, in its middle.
using SampleOf = std::function<std::optional<GreySample>(int u, int v)>;
std::vector<FoundQuarters> find_quarters(const GreyPicture& picture, const SampleOf& sample_of, Progress& progress);

}  // namespace adit
