#pragma once
// Volumes between two chainages by thin slices with plan curvature, other methods beside them.

#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/foundation/progress.h"
#include "core/profiling/deviation_map.h"
#include "core/profiling/round_review.h"
#include "core/profiling/section.h"
#include "core/profiling/sectors.h"
#include "core/registration/registration.h"

namespace adit {

struct VolumeAmounts {
  double design_m3 = 0.0;
  double excavated_m3 = 0.0;
  double overbreak_m3 = 0.0;
  double underbreak_m3 = 0.0;
};

/// The volume of the surface mesh: an opinion by another way (core/profiling/mesh_volume.h).
struct MeshVolume {
  bool there = false;  ///< the job has a mesh
  double excavated_m3 = 0.0;
  double filled_m2 = 0.0;  ///< of holes and jagged ends within the stretch, closed by triangles
  bool closed = false;     ///< otherwise the mesh ends within the stretch, or is torn, and there is no volume
};

/// One line, one stretch. sigma are one standard deviation.
struct Volume {
  std::string line;
  double line_offset_m = 0.0;
  double line_growth_per_m = 0.0;
  double from_m = 0.0;
  double to_m = 0.0;
  VolumeAmounts slices;            ///< thin slices with plan curvature: the number to use
  VolumeAmounts average_end_area;  ///< from the sections at the job's interval
  VolumeAmounts prismoidal;
  MeshVolume mesh;
  double sigma_excavated_m3 = 0.0;
  double sigma_overbreak_m3 = 0.0;
  double sigma_underbreak_m3 = 0.0;
  double coverage = 0.0;  ///< measured share of the surface, openings left out
  double measured_m2 = 0.0;
  double interpolated_m2 = 0.0;
  double unseen_m2 = 0.0;
  double opening_m2 = 0.0;  ///< cross-cuts and deep niches, cut off at the line
  double closure_m3 = 0.0;  ///< (excavated - design) - (over - under): zero but for rounding
  std::vector<SectorVolume> sectors;
};

/// The sector with the deepest overbreak; an empty one where there is none.
inline SectorVolume worst_sector(const Volume& volume) {
  SectorVolume worst;
  for (const SectorVolume& sector : volume.sectors)
    if (sector.max_overbreak_m > worst.max_overbreak_m) worst = sector;
  return worst;
}

/// A blasting round with its own volumes and review against the reference line.
struct RoundVolume {
  int number = 0;
  double drilled_m = 0.0;  ///< 0 when not stated
  double pull_m = 0.0;     ///< the round's length in the job, which may be more than was profiled
  double loose_m3 = 0.0;   ///< excavated volume times the swell; 0 when no swell is stated
  RoundReview review;
  Volume volume;
};

}  // namespace adit
