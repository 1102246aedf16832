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

  /// Divergence theorem: with F = (0, x/2 - k x^2/3, z (1/2 - k x/3)) in (s, x, z), div F = 1 - k x, the volume of a
  /// slice with plan curvature k, and no part of F goes through planes across the axis, so that the ends need no lids.
  MeshVolume between(double from_m, double to_m) const;

 private:
  struct Triangle {
    std::array<Eigen::Vector3d, 3> corners;  ///< (s, x, z)
    double curvature_per_m = 0.0;
    bool filled = false;
  };
  void add(const std::array<Eigen::Vector3d, 3>& corners, const Alignment& axis, bool filled);
  void flatten(const std::vector<Eigen::Vector3d>& rim, const Alignment& axis);

  std::vector<Triangle> triangles_;
  double middle_s_m_ = 0.0;
  bool one_tube_ = true;  ///< all its loops are closed, but for one end to either side
  double from_m_ = std::numeric_limits<double>::infinity();  ///< the flat ends: between them the mesh is closed
  double to_m_ = -std::numeric_limits<double>::infinity();
};

}  // namespace adit
