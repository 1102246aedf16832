#pragma once
// The surface of a simulated tunnel as triangles, to be looked at.

#include <vector>

#include "core/geometry/pose.h"
#include "core/simulation/rock_tunnel.h"
#include "core/surface/mesh.h"

namespace adit {

struct RockMesh {
  MeshArrays mesh;            ///< frame of the tunnel's design
  std::vector<float> albedo;  ///< of each point: rough rock, dark and bright by patches; the floor darker
};

/// Rock between two chainages in steps of step_m along and around, and the face where it lies between them.
RockMesh rock_mesh(const RockTunnel& tunnel, double from_m, double to_m, double step_m);

/// The place of a thing that hangs on the rock: at a chainage and arc length p of the profile, so far before the
/// rock, looking into the tunnel (z along the inward normal of the profile, y as upright as that permits).
Pose place_on_rock(const RockTunnel& tunnel, double chainage_m, double p_m, double before_m);

/// The same, turned towards those who come up the chainage, as targets are hung so that they are seen from afar.
Pose place_facing_back(const RockTunnel& tunnel, double chainage_m, double p_m, double before_m);

}  // namespace adit
