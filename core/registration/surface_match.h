#pragma once
// Pieces of two scans' surfaces laid upon each other, and what the distances between them say about the pose.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"
#include "core/registration/surface_map.h"

namespace adit {

/// A source's piece over the target's surface. Target's frame.
struct SurfaceMatch {
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();           ///< from the source's origin to the piece
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();       ///< half-way between those of both surfaces
  double residual_m = 0.0;                                 ///< along the normal
  double distance_m = 0.0;                                 ///< to the nearest piece of the target
  Eigen::Vector3d normal_error = Eigen::Vector3d::Zero();  ///< half the difference of the two: as good as its error
};

/// Of fewer matches nothing can be said.
inline constexpr std::size_t least_matches = 50;

/// A source's piece and what the target has near it.
struct Meeting {
  bool near = false;                  ///< the target has pieces within one cell, whichever way they face
  std::optional<SurfaceMatch> match;  ///< where some of them face as the source's piece does
};
/// from_origins: both scanners stood at the origin of their scans. Then a surface that one of them clearly saw from its
/// other side is another one: the two faces of a pillar, a box, a rib.
Meeting meeting_of(const SurfaceMap& target, const SurfacePiece& piece, const Pose& target_from_source,
                   bool from_origins);

/// For every source piece with target pieces within one cell that face the same way (32 degrees): the distance to the
/// surface that these make together, with the weights w of near_weight (implicit moving least squares, Kolluri
/// 2008),
///   residual = sum w n . (q - t) / sum w,   n = (n_t + R n_s) / 2,
/// the normals of both sides halved (the symmetric metric of Rusinkiewicz 2019: exact on surfaces that curve).
/// enough: so many source pieces or a few less, evenly taken; all by default.
std::vector<SurfaceMatch> surface_matches(const SurfaceMap& target, const SurfaceMap& source,
                                          const Pose& target_from_source, Progress& progress,
                                          std::size_t enough = std::numeric_limits<std::size_t>::max());

/// [arm x n, n]: what a turn [rad] about the source's origin and a shift do to the residual.
inline Vector6d jacobian_of(const SurfaceMatch& match) {
  Vector6d j;
  j << match.arm.cross(match.normal), match.normal;
  return j;
}

/// Tukey's weight of a residual: none beyond the reach.
inline double tukey_weight(double residual_m, double reach_m) {
  const double left = 1.0 - residual_m * residual_m / (reach_m * reach_m);
  return left > 0.0 ? left * left : 0.0;
}

/// The derivative of Tukey's weight times residual.
inline double tukey_curvature(double residual_m, double reach_m) {
  const double u2 = residual_m * residual_m / (reach_m * reach_m);
  return u2 < 1.0 ? (1.0 - u2) * (1.0 - 5.0 * u2) : 0.0;
}

/// Sums over matches with J = [arm x n, n] (rotation [rad] about the source's origin, then translation [m]) and Tukey's
/// weights w of the given reach.
struct NormalEquations {
  Matrix6d hessian = Matrix6d::Zero();  ///< sum w J^T J
  Vector6d gradient = Vector6d::Zero();
  double weight = 0.0;     ///< sum w
  double curvature = 0.0;  ///< sum of the derivative of w r by r: less than the weight, as far ones pull less
  /// The part of the hessian that comes from the normals' own errors e, measured: sum w B e e^T B^T with B = [[arm]x;
  /// I]. A featureless wall seen with noise has a hessian along itself made of noise alone.
  Matrix6d noise = Matrix6d::Zero();

  /// Far matches pull less the farther they are: the cost bends less than the weights say, and steps would be short by
  /// this.
  double bend() const { return std::clamp(curvature / std::max(weight, 1e-9), 0.4, 1.0); }

  NormalEquations& operator+=(const NormalEquations& other);
};
NormalEquations normal_equations(std::span<const SurfaceMatch> matches, double tukey_m);

/// Sums over the matches of one cube of space, weighted as those of NormalEquations.
struct CubeSums {
  std::uint64_t key = 0;  ///< cell_key
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
};
/// Matches summed up by cubes of edge cube_m, within which surfaces may err together. In the order of their keys.
std::vector<CubeSums> sums_by_cubes(std::span<const SurfaceMatch> matches, double tukey_m, double cube_m);

/// The sums of cubes twice as large.
std::vector<CubeSums> with_double_cubes(const std::vector<CubeSums>& cubes);

}  // namespace adit
