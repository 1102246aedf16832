#pragma once
// Holes of a surface, closed so that a volume can be taken.

#include <cstdint>
#include <functional>
#include <vector>

#include "core/surface/mesh.h"

namespace adit {

/// Points of a boundary loop, in the order in which triangles that close it would run along its rim.
using MeshLoop = std::vector<std::uint32_t>;

struct FilledMesh {
  MeshArrays mesh;             ///< the points of the input, its triangles, and the new ones behind them
  std::vector<MeshLoop> open;  ///< loops that stayed as they were: on request, or because no triangles close them
  bool joined = true;          ///< false: some triangles of the input fit to no others (three at one edge) and are out
};

/// Closes boundary loops by triangles of least area and bend (Liepa 2003, by CGAL), but those for which `stays_open`
/// holds: the ends of a tunnel.
FilledMesh fill_holes(const MeshArrays& mesh, const std::function<bool(const MeshLoop& loop)>& stays_open);

}  // namespace adit
