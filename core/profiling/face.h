#pragma once
// The face: the rock at the end of the tunnel, as a grid over the section plane.

#include <cstdint>
#include <limits>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/foundation/progress.h"
#include "core/profiling/placed_tiles.h"

namespace adit {

enum class FaceKind : std::uint8_t {
  beside = 0,  ///< outside the design profile, or nearer to its line than inset_m
  unseen = 1,
  hidden = 2,  ///< muck in front of it, or rock left at its foot: what stands over half a metre before the face's
               ///< middle from the floor upwards
  seen = 3,
};

struct FaceCell {
  double chainage_m = std::numeric_limits<double>::quiet_NaN();  ///< of a seen cell
  FaceKind kind = FaceKind::beside;
};

/// Cells of step_m over offset x (columns) and height z (rows), row-major from the lower left. No cells: no face seen.
struct FaceMap {
  double x_from_m = 0.0;
  double z_from_m = 0.0;
  double step_m = 0.1;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<FaceCell> cells;

  Eigen::Vector2d middle(std::size_t column, std::size_t row) const {
    return {x_from_m + (static_cast<double>(column) + 0.5) * step_m,
            z_from_m + (static_cast<double>(row) + 0.5) * step_m};
  }
};

struct FaceSummary {
  double mean_m = 0.0;  ///< chainage, of seen cells
  double least_m = 0.0;
  double greatest_m = 0.0;
  double spread_m = 0.0;  ///< standard deviation
  double seen_m2 = 0.0;
  double hidden_m2 = 0.0;
  double design_m2 = 0.0;  ///< inside the profile, less inset_m
  double share() const { return design_m2 > 0.0 ? seen_m2 / design_m2 : 0.0; }
};

struct FaceOptions {
  double least_step_m = 0.1;  ///< of the grid; sparse scans get wider cells, up to 0.5 m
  double inset_m = 0.15;      ///< nearer to the design line a point may belong to the wall
  double relief_m = 1.5;      ///< the face lies within so much of its middle
  double least_share = 0.4;   ///< with less of the profile seen at one place there is no face
  int least_points = 3;       ///< of a cell
  double least_range_m = 0.6;
  double most_range_m = 45.0;
};

/// The farthest surface in the direction of drive, cell by cell, in the planes of the design. Without cells when the
/// tunnel is open within sight, or too little of the face was seen.
FaceMap find_face(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                  const FaceOptions& options, Progress& progress);

FaceSummary summarise(const FaceMap& face);

/// The face everywhere on its grid: cells that were not seen have the chainage of the nearest one that was.
std::vector<double> filled_face(const FaceMap& face);

}  // namespace adit
