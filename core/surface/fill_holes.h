#pragma once
// Holes of a surface, closed so that a volume can be taken.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/surface/mesh.h"

namespace adit {

/// Points of every boundary loop, in order.
std::vector<std::vector<std::uint32_t>> boundary_loops(const MeshArrays& mesh);

struct FilledMesh {
  MeshArrays mesh;  ///< the points of the input, its triangles, and the new ones behind them
  std::size_t holes = 0;
  double filled_m2 = 0.0;
};

/// Closes boundary loops by triangles of least area and bend (Liepa 2003, by CGAL). Loops, given by their
/// points in order, for which `stays_open` holds stay as they are: the ends of a tunnel.
FilledMesh fill_holes(const MeshArrays& mesh,
                      const std::function<bool(const std::vector<std::uint32_t>& loop)>& stays_open);

}  // namespace adit
