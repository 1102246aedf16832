#pragma once
// A scan made ready for matching: even subsample, search tree, normals, normal distributions.

#include <memory>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/nearest_neighbours.h"
#include "core/geometry/normals.h"
#include "core/geometry/tile_source.h"
#include "core/registration/distribution_map.h"

namespace adit {

/// Scan frame throughout.
struct PreparedScan {
  std::string name;
  double spacing_m = 0.0;  ///< of the points
  std::vector<Eigen::Vector3f> points;
  std::vector<SurfaceNormal> normals;
  std::shared_ptr<const NearestNeighbours> tree;
  DistributionPyramid pyramid;  ///< from cells of twice the spacing on, of all points that were read
};

/// Points at an even spacing (halved, twice at most, while a scan of a small room leaves fewer than 20,000 of them),
/// ranges from least to most; the scanner at the origin sees every normal's face (with no limit on ranges, the middle
/// of the points does: where the scanner stood is unknown then). Throws Error when fewer than 500 points remain.
PreparedScan prepare_scan(const std::string& name, const TileSource& source, double spacing_m, double least_range_m,
                          double most_range_m, Progress& progress);

}  // namespace adit
