#pragma once
// Dark patches of a picture by size: where the centre discs of coded targets may be.

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <vector>

#include "core/foundation/angle.h"
#include "core/geometry/grey_picture.h"

namespace adit {

/// Half the size: each pixel the mean of four. Pixel (u, v) stands at (2 u + 0.5, 2 v + 0.5) of the picture it came
/// from.
GreyPicture half_size(const GreyPicture& picture);

/// Noise of the pixels [grey levels, one sigma]: from the differences of neighbours, half of which lie nearer.
double noise_of(const GreyPicture& picture);

/// A connected dark patch: its pixels count with their whole area.
struct DarkBlob {
  double area_px2 = 0.0;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();

  /// Area over that of the ellipse with these moments: 1 for a disc, less for lines and crosses. Wants a covariance
  /// that is positive definite.
  double fill() const { return area_px2 / (4.0 * pi * std::sqrt(covariance_px2.determinant())); }
};

struct DarkBlobOptions {
  int window_px = 31;           ///< side of the square whose mean decides; at most 255
  double least_contrast = 3.0;  ///< grey levels darker than that mean
  double least_area_px2 = 7.0;
  double most_area_px2 = 700.0;
};

/// Pixels darker than the mean about them, put together where they share a side. Patches that touch the rim are left
/// out.
std::vector<DarkBlob> dark_blobs(const GreyPicture& picture, const DarkBlobOptions& options);

}  // namespace adit
