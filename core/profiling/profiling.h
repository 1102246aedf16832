#pragma once
// Registered scans and a design to the deviation map, sections and volumes.

#include <cstdint>
#include <vector>

#include "core/foundation/finding.h"
#include "core/foundation/progress.h"
#include "core/profiling/placed_tiles.h"
#include "core/profiling/section.h"
#include "core/profiling/volume.h"

namespace adit {

struct ProfilingOptions {
  double slice_m = 0.10;              ///< thickness of a slice along the chainage
  double cell_m = 0.10;               ///< width of a cell along the design line
  double gap_m = 1.5;                 ///< gaps of the outline up to this are interpolated and counted apart
  double reach_out_m = 3.0;           ///< points farther outside the line are not of this tunnel
  double reach_in_m = 0.6;            ///< points farther inside the line are equipment, people or muck, not rock
  double surface_band_m = 0.10;       ///< points this close behind one another are one surface
  int least_points = 3;               ///< a cell with fewer points is not measured
  int most_points_a_cell = 200;       ///< of all scans; of more an even subsample of each is taken
  double least_range_m = 0.6;         ///< nearer points are the scanner itself
  double most_range_m = 45.0;         ///< farther points are too oblique to be used
  double range_bias_sigma_m = 0.001;  ///< systematic error of the scanner's distances, for the uncertainty of volumes
};

template <typename Visitor>
void describe(Visitor& v, ProfilingOptions& o) {
  v.number("slice_m", o.slice_m, "m", 0.01, 1.0, "thickness of a slice along the chainage");
  v.number("cell_m", o.cell_m, "m", 0.01, 1.0, "width of a cell along the design line");
  v.number("gap_m", o.gap_m, "m", 0.0, 5.0, "gaps of the outline up to this are interpolated and counted apart");
  v.number("reach_out_m", o.reach_out_m, "m", 0.1, 20.0, "points farther outside the line are not of this tunnel");
  v.number("reach_in_m", o.reach_in_m, "m", 0.05, 20.0, "points farther inside the line are not rock");
  v.number("surface_band_m", o.surface_band_m, "m", 0.005, 1.0, "points this close behind one another are one surface");
  v.count("least_points", o.least_points, "", 1, 100, "a cell with fewer points is not measured");
  v.count("most_points_a_cell", o.most_points_a_cell, "", 20, 1000000,
          "of all scans, 20 of each at least; of more an even subsample is taken");
  v.number("least_range_m", o.least_range_m, "m", 0.0, 10.0, "nearer points are the scanner itself");
  v.number("most_range_m", o.most_range_m, "m", 1.0, 1000.0, "farther points are too oblique to be used");
  v.number("range_bias_sigma_m", o.range_bias_sigma_m, "m", 0.0, 0.1,
           "systematic error of the scanner's distances, for the uncertainty of volumes");
}

/// Streams every tile that reaches the stretch [from, to] into the map. The design is in the local frame. Of a dense
/// tile an even prefix is read, its scan's share of most_points_a_cell (20 at least) for each cell it may touch.
/// memory_bytes bounds the points in memory at a time (one row of the map at the least); it does not change the result.
struct MapResult {
  DeviationMap map;
  std::uint64_t points_used = 0;
  std::uint64_t points_inside = 0;   ///< left out: farther inside the line than reach_in_m
  std::uint64_t points_outside = 0;  ///< left out: farther outside than reach_out_m; many make a cell an opening
  std::uint64_t sparse_cells = 0;    ///< left out: cells with fewer points than least_points
  Findings findings;
};
inline constexpr std::uint64_t ample_memory_bytes = std::uint64_t{1} << 30;
MapResult map_deviations(const std::vector<PlacedTiles>& scans, const DesignTunnel& design, double from_m, double to_m,
                         const ProfilingOptions& options, Progress& progress,
                         std::uint64_t memory_bytes = ample_memory_bytes);
MapResult map_deviations(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                         double from_m, double to_m, const ProfilingOptions& options, Progress& progress,
                         std::uint64_t memory_bytes = ample_memory_bytes);

/// The section at a chainage straight from the points: reads the tiles within two slices of it. Objects in front of the
/// rock are judged by these slices alone.
Section cut_section(const std::vector<PlacedTiles>& scans, const ChainageIndex& index, const DesignTunnel& design,
                    double chainage_m, const ProfilingOptions& options, Progress& progress);

/// The section at a chainage: the mean of the map rows it touches.
Section cut_section(const DeviationMap& map, const DesignTunnel& design, double chainage_m,
                    const ProfilingOptions& options);

/// Chainages from, from + interval, ... up to and including to.
std::vector<double> section_chainages(double from_m, double to_m, double interval_m);

/// Volumes of a stretch against one line: thin slices, each dV = ds * (A - k M) with plan curvature k (right positive),
/// area A and first moment M about the axis. Average end area and prismoidal from sections every interval_m beside it.
Volume compute_volume(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line, double from_m,
                      double to_m, double interval_m, const RegistrationResult& registration,
                      const ProfilingOptions& options, Progress& progress);

}  // namespace adit
