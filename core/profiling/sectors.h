#pragma once
// Over- and underbreak by sector of the profile: crown, shoulders, walls, invert.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/deviation_map.h"

namespace adit {

/// A part of the profile by where its outward normal points: degrees clockwise from straight up, looking up-chainage,
/// -180 to 180. to_deg below from_deg: through straight down.
struct Sector {
  std::string name;
  double from_deg = 0.0;
  double to_deg = 0.0;
  bool operator==(const Sector&) const = default;
};

/// crown -30 to 30, shoulders to 70, walls to 135, invert.
std::vector<Sector> standard_sectors();

/// Throws Error when sectors leave gaps, overlap, have no name or two have one.
void check_sectors(const std::vector<Sector>& sectors);

/// Index of the sector that holds an outward normal.
std::size_t sector_of(const std::vector<Sector>& sectors, const Eigen::Vector2d& normal);

/// What of a stretch lies in one sector, against one line.
struct SectorVolume {
  std::string name;
  double surface_m2 = 0.0;  ///< of the line
  double measured_m2 = 0.0;
  double overbreak_m3 = 0.0;
  double underbreak_m3 = 0.0;
  double max_overbreak_m = 0.0;  ///< of measured places; 0 when there is none
  double max_overbreak_chainage_m = 0.0;
  double max_overbreak_clock_deg = 0.0;  ///< of the normal there
};

/// Each piece between two neighbouring normals of the outline belongs to the sector of its normal; its over and under
/// are the quadrilaterals between line and outline, with plan curvature as in compute_volume. The sectors sum to the
/// slices' volumes where outlines do not fold over themselves.
std::vector<SectorVolume> sector_volumes(const DeviationMap& map, const DesignTunnel& design, const DesignLine& line,
                                         const std::vector<Sector>& sectors, double from_m, double to_m, double gap_m);

}  // namespace adit
