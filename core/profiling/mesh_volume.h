#pragma once
// What a surface mesh holds between two chainages: an opinion beside the slices, by another way.

#include <array>
#include <limits>
#include <vector>

#include "core/design/design_tunnel.h"
#include "core/profiling/volume.h"

namespace adit {

struct MeshArrays;

/// A mesh of a tunnel (frame of the design) with its holes closed, in tunnel coordinates; made once, asked often.
/// Pieces without a loop that goes around the axis are no tunnel (parts of machines, islands in a hole) and are left
/// out.
class MeshInTunnel {
 public:
  /// Loops that go around the axis are the tunnel's ends. Their rims are made flat: walls parallel to the axis lead
  /// from each edge to the plane of the outermost point.
  MeshInTunnel(const MeshArrays& mesh, const DesignTunnel& design);

  /// Divergence theorem: with F = (0, x f, z f), f = a/2 - b x/3 - c z/3, in (s, x, z), div F = a - b x - c z, what a
  /// slice holds at a place (SliceShape), and no part of F goes through the sections' planes, so that the ends need no
  /// lids.
  MeshVolume between(double from_m, double to_m) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;  ///< (s, x, z)
    SliceShape shape;
    bool filled = false;
  };
  void add(const std::array<Eigen::Vector3d, 3>& corners, const DesignTunnel& design, bool filled);
  void flatten(const std::vector<Eigen::Vector3d>& rim, const DesignTunnel& design);

  std::vector<Triangle> triangles_;
  double middle_s_m_ = 0.0;
  bool one_tube_ = true;  ///< all its loops are closed, but for one end to either side
  double from_m_ = std::numeric_limits<double>::infinity();  ///< the flat ends: between them the mesh is closed
  double to_m_ = -std::numeric_limits<double>::infinity();
};

}  // namespace adit
