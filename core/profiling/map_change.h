#pragma once
// Two deviation maps of one design: thickness of a layer, and what has changed for certain.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/profiling.h"
#include "core/profiling/sectors.h"
#include "core/registration/registration.h"

namespace adit {

/// What a layer (shotcrete) should be. 0: not said.
struct LayerDesign {
  double minimum_m = 0.0;
  double nominal_m = 0.0;
  std::vector<std::string> sectors;  ///< that get the layer; empty: all
  bool operator==(const LayerDesign&) const = default;
};

/// A piece of the surface of about a square metre.
struct LayerBlock {
  double chainage_m = 0.0;  ///< of its middle
  double p_m = 0.0;
  double measured_m2 = 0.0;
  double mean_m = 0.0;   ///< thickness: positive where rock or concrete came in, negative where some is gone
  double sigma_m = 0.0;  ///< of the mean, registration and distances of both epochs included
};

struct LayerResult {
  LayerDesign design;
  double surface_m2 = 0.0;   ///< of the line, in the layer's sectors
  double measured_m2 = 0.0;  ///< measured in both epochs
  double mean_m = 0.0;
  double volume_m3 = 0.0;  ///< of the measured surface alone
  double sigma_volume_m3 = 0.0;
  double missing_m2 = 0.0;       ///< of the line, not measured in both
  double whole_volume_m3 = 0.0;  ///< with the mean thickness where it was not measured
  double sigma_whole_m3 = 0.0;   ///< what is missing may all be off by as much as square metres differ
  // Shares of the measured blocks, by their means.
  double below_minimum = 0.0;
  double below_nominal = 0.0;  ///< from minimum to nominal
  double from_nominal = 0.0;
  std::vector<LayerBlock> blocks;  ///< at least half measured; in order of chainage, then p
};

/// Level of detection at 95 %: 1.96 sqrt(s1^2/n1 + s2^2/n2 + registration^2) (Lague, Brodu, Leroux 2013, equation 1);
/// the distances' systematic error counts as registration.
struct ChangeResult {
  double level_m = 0.0;  ///< median over the cells
  double compared_m2 = 0.0;
  double inwards_m2 = 0.0;   ///< significant change: the surface came in ...
  double outwards_m2 = 0.0;  ///< ... or went out
  double inwards_m3 = 0.0;
  double outwards_m3 = 0.0;
};

struct MapChange {
  DeviationMap thickness;  ///< before less after, of cells measured in both; spread is the level of detection
  LayerResult layer;
  ChangeResult change;
};

/// before and after: maps of the same design and grid. Thickness counts along the outward normal of the profile; the
/// surface of a cell at half-way depth is (1 + kp d)(1 - kh x) of that of the profile. Throws Error when the grids
/// differ or the layer names a sector that is none. Changes are looked for in every sector. The distances' systematic
/// error is that of each epoch by itself.
MapChange compare_maps(const DeviationMap& before, const DeviationMap& after, const DesignTunnel& design,
                       const LayerDesign& layer, const std::vector<Sector>& sectors,
                       const RegistrationResult& registration_before, const RegistrationResult& registration_after,
                       const ProfilingOptions& options);

}  // namespace adit
