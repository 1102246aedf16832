#pragma once
// A scan made ready for matching: even subsample, pieces of surface, normal distributions, what the scanner saw
// through.

#include <optional>
#include <string>
#include <vector>

#include "core/foundation/error.h"
#include "core/foundation/progress.h"
#include "core/geometry/tile_source.h"
#include "core/registration/distribution_map.h"
#include "core/registration/free_space.h"
#include "core/registration/surface_map.h"

namespace adit {

/// Scan frame throughout.
struct PreparedScan {
  std::string name;
  double spacing_m = 0.0;               ///< of the points
  std::vector<Eigen::Vector3f> points;  ///< even subsample
  DistributionPyramid pyramid;          ///< from cells of twice the spacing on, of all points that were read
  std::vector<SurfaceMap> surfaces;     ///< pieces of piece_m, and twice, ... as large, to eight spacings
  double piece_m = 0.0;                 ///< size of the finest pieces that hold two points each or so
  double noise_m = 0.0;                 ///< median thickness of flat pieces of 0.2 m; 0: too few of them
  RangeImage ranges;                    ///< of nothing where the file does not say where the scanner stood
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< unit direction that the fewest walls face: along a tunnel
  std::optional<Error> too_few_points;              ///< why it cannot be matched; nothing but points is set then

  /// The pieces whose size is nearest, by ratio.
  const SurfaceMap& surface(double size_m) const;
};

/// Points at an even spacing (halved, twice at most, while a scan of a small room leaves fewer than 20,000 of them),
/// ranges from least to most; with no limit on ranges (1e9) the scanner does not stand at the origin. Without
/// 500 points it says so (too_few_points).
PreparedScan prepare_scan(const std::string& name, const TileSource& source, double spacing_m, double least_range_m,
                          double most_range_m, Progress& progress);

}  // namespace adit
