#pragma once
// Even subsampling on a grid of cubes.

#include "core/foundation/progress.h"
#include "core/geometry/tile_source.h"

namespace adit {

/// The mean point of every occupied cube of edge spacing_m (cubes aligned with the frame's origin), in the order of the
/// cubes, so that the result depends on the points alone and not on their order. Attributes are dropped.
/// Throws Error when the cloud reaches over more than two million cubes along one axis.
PointCloud even_subsample(const PointCloud& cloud, double spacing_m);

/// The same of a stream of tiles; points nearer than least_range_m or farther than most_range_m from the frame's origin
/// are left out. Memory grows with the cubes, not with the points: of a dense tile only an even prefix is read, about
/// 64 points for each cube its box may touch.
PointCloud even_subsample(const TileSource& source, double spacing_m, double least_range_m, double most_range_m,
                          Progress& progress);

}  // namespace adit
