#pragma once
// A deviation map against a set of tolerances.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/design/tolerances.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/profiling.h"
#include "core/profiling/sectors.h"

namespace adit {

/// One sector of one rock class against its limits. Of the measured cells alone.
struct ToleranceCheck {
  std::string rock_class;
  std::string sector;
  ToleranceRow limits;
  double surface_m2 = 0.0;
  double measured_m2 = 0.0;
  double mean_overbreak_m = 0.0;
  double max_overbreak_m = 0.0;
  double max_overbreak_chainage_m = 0.0;
  double max_underbreak_m = 0.0;
  double max_underbreak_chainage_m = 0.0;
  double max_underbreak_area_m2 = 0.0;  ///< largest patch of cells that lie more than 1 cm inside the line
  // What remains of each by two sigmas: of registration, distances and noise. Of the areas, the patch of cells that lie
  // inside by more than that.
  double sure_mean_overbreak_m = 0.0;
  double sure_overbreak_m = 0.0;
  double sure_underbreak_m = 0.0;
  double sure_underbreak_area_m2 = 0.0;
  double over_limit_m2 = 0.0;   ///< surface beyond max_overbreak_m
  double under_limit_m2 = 0.0;  ///< surface beyond max_underbreak_m

  double coverage() const { return surface_m2 > 0.0 ? measured_m2 / surface_m2 : 0.0; }
  /// A limit is broken by what was measured, whatever was not seen.
  bool broken() const {
    return sure_mean_overbreak_m > limits.mean_overbreak_m || sure_overbreak_m > limits.max_overbreak_m ||
           sure_underbreak_m > limits.max_underbreak_m || sure_underbreak_area_m2 > limits.max_underbreak_area_m2;
  }
  bool beyond() const {
    return mean_overbreak_m > limits.mean_overbreak_m || max_overbreak_m > limits.max_overbreak_m ||
           max_underbreak_m > limits.max_underbreak_m || max_underbreak_area_m2 > limits.max_underbreak_area_m2;
  }
  /// Nothing beyond proves little where less than this was seen.
  static constexpr double least_coverage = 0.8;
  ToleranceVerdict verdict() const {
    if (broken()) return ToleranceVerdict::broken;
    if (beyond()) return ToleranceVerdict::undecided;
    return coverage() >= least_coverage ? ToleranceVerdict::kept : ToleranceVerdict::not_shown;
  }
};

/// Every sector of every rock class that the map holds and the set limits, in order of chainage and sectors.
std::vector<ToleranceCheck> check_tolerances(const DeviationMap& map, const DesignTunnel& design,
                                             const DesignLine& line, const std::vector<Sector>& sectors,
                                             const ToleranceSet& set, const std::vector<RockClassFrom>& classes,
                                             const RegistrationResult& registration, const ProfilingOptions& options);

}  // namespace adit
