#pragma once
// The normal distributions of a scan seen from above (Magnusson et al., figure 6).

#include <vector>

#include "core/geometry/pose.h"
#include "core/registration/distribution_map.h"

namespace adit {

struct ProbabilityImage {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< lower left, x and y in the frame asked for [m]
  double pixel_m = 0.05;
  int width = 0;
  int height = 0;
  std::vector<float> density_per_m2;  ///< seen from above; rows from the lowest y

  float at(int column, int row) const {
    return density_per_m2[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(column)];
  }
};

/// The mixture of all cells, each alike as in the transform's score, over x and y of another frame. At most
/// most_pixels: pixels are made larger for larger scans. Error for no distributions.
ProbabilityImage probability_from_above(const DistributionMap& cells, const Pose& frame_from_scan, double pixel_m,
                                        std::size_t most_pixels = 4000000);

}  // namespace adit
