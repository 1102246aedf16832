#pragma once
// Points as the stages of iterative closest point want them.

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/nearest_neighbours.h"
#include "core/registration/icp_options.h"
#include "core/registration/surface_map.h"

namespace adit {

/// Scan frame, the scanner at its origin.
struct IcpCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< unit, either way; empty: not known
};
IcpCloud icp_cloud(const SurfaceMap& surface);

/// Which points lie at the rim of what was measured: seen from a point, its 16 nearest leave an angle of 110 degrees
/// free.
std::vector<std::uint8_t> boundary_points(const IcpCloud& cloud, const NearestNeighbours& tree);

/// A target, ready to be asked for matches.
class IcpTarget {
 public:
  /// Prepares what the options' matching and rejection ask for. Throws Error for no points, or for no normals where the
  /// options need them.
  IcpTarget(IcpCloud cloud, const IcpOptions& options);

  struct Match {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    std::size_t index = 0;  ///< of the point there, or next to there
  };
  /// Of a place with a normal (zero: not known) in the target's frame; nothing beyond the reach.
  std::optional<Match> match(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, double reach_m) const;

  const IcpCloud& cloud() const { return cloud_; }
  bool is_boundary(std::size_t index) const { return !boundary_.empty() && boundary_[index] != 0; }

 private:
  std::optional<Match> shot_at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal) const;

  IcpCloud cloud_;
  IcpMatching matching_;
  NearestNeighbours tree_;                       ///< of the points
  std::optional<NearestNeighbours> directions_;  ///< of unit vectors to the points, for projection
  std::vector<std::uint8_t> boundary_;
};

}  // namespace adit
