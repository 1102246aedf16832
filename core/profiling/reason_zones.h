#pragma once
// Overbreak by its reason: zones that a person has marked, and what lies in them.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/sectors.h"

namespace adit {

/// A piece of the tunnel with the reason of its overbreak. Degrees as in Sector; -180 to 180 is the whole profile.
struct ReasonZone {
  double from_m = 0.0;  ///< chainage
  double to_m = 0.0;
  double from_deg = -180.0;
  double to_deg = 180.0;
  std::string reason;  ///< one of reason_codes()
  std::string note;
  bool operator==(const ReasonZone&) const = default;
};

/// "technical", "geological", "look_out", "other".
const std::vector<std::string>& reason_codes();

/// Throws Error when two zones overlap: their overbreak would count twice.
void check_zones(const std::vector<ReasonZone>& zones);

struct ZoneVolume {
  ReasonZone zone;  ///< cut to the map where it reaches it
  SectorVolume amounts;
};

/// What lies in each zone against one line; zones beyond the map have none.
std::vector<ZoneVolume> zone_volumes(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line,
                                     const std::vector<ReasonZone>& zones, double gap_m);

}  // namespace adit
