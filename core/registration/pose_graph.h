#pragma once
// All pairs, guesses and control points in one adjustment.

#include <optional>
#include <string>
#include <vector>

#include "core/foundation/progress.h"
#include "core/geometry/pose.h"

namespace adit {

/// A measured transform between two nodes with its information about (rotation [rad], translation [m]) in the target's
/// frame at the source's origin.
struct GraphPair {
  std::size_t source = 0;
  std::size_t target = 0;
  Pose target_from_source = Pose::Identity();
  Matrix6d information = Matrix6d::Zero();
};

/// A target seen from a node, and where it is.
struct GraphControl {
  std::size_t node = 0;
  std::string id;  ///< of the control point
  Eigen::Vector3d in_scan = Eigen::Vector3d::Zero();
  Eigen::Vector3d in_local = Eigen::Vector3d::Zero();
};

struct PoseGraph {
  std::vector<Pose> local_from_scan;  ///< starting values
  std::vector<GraphPair> pairs;
  std::vector<GraphControl> control;
  /// This node does not move; needed when there is no control. Its own guess is off, too: the others are held at theirs
  /// but for a move of all together, as much as one guess may be off.
  std::optional<std::size_t> datum;
  std::vector<bool> guessed;  ///< nodes held, loosely, at their starting value; those beyond its end are, too
  double guess_sigma_m = 0.5;
  double guess_sigma_rad = 0.035;
  double control_sigma_m = 0.002;
  bool with_covariance = true;  ///< false: for trials, which need none
};

struct PoseGraphResult {
  std::vector<Pose> local_from_scan;
  std::vector<Matrix6d> covariance;  ///< of (rotation, translation) per node, local axes
  double cost = 0.0;                 ///< half the sum of squares that was minimised, after the robust losses
  std::vector<double> pair_misfit;   ///< squared residual of each pair in its own sigmas (6 are expected)
  std::vector<Eigen::Vector3d> control_residual_m;
  Pose moved_from_guesses = Pose::Identity();  ///< what all guesses move by to stand about the datum; without it none
};

/// Least squares with Cauchy's loss on the pairs, so that a wrong pair does not pull the rest (Ceres). Such a loss has
/// more than one minimum: it begins at the starting values and, once more, where the best known pairs chain the nodes
/// from the datum on; the less costly of both is the result. Deterministic.
PoseGraphResult solve_pose_graph(const PoseGraph& graph, Progress& progress);

}  // namespace adit
