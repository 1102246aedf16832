#pragma once
// All pairs, guesses and control points in one adjustment.

#include <cmath>
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
  double sigma_m = 0.0;  ///< of the target itself, beside the graph's for all
};

/// A camera fixed to the scanner of every node: where it sits, as well as that is known.
struct GraphCamera {
  Pose scan_from_camera = Pose::Identity();
  double sigma_m = 0.002;
  double sigma_rad = 0.001;
};

/// Where a node's camera stood, as its picture says, with the information about (rotation [rad], translation [m]) in
/// local axes.
struct GraphSight {
  std::size_t node = 0;
  std::size_t camera = 0;
  Pose local_from_camera = Pose::Identity();
  Matrix6d information = Matrix6d::Zero();
};

struct PoseGraph {
  std::vector<Pose> local_from_scan;  ///< starting values
  std::vector<GraphPair> pairs;
  std::vector<GraphControl> control;
  std::vector<GraphCamera> cameras;  ///< adjusted with the nodes: one that sits otherwise than it is said shows in all
  std::vector<GraphSight> sights;
  /// This node does not move; needed when there is neither control nor a sight. Its own guess is off, too: the others
  /// are held at theirs but for a move of all together, as much as one guess may be off.
  std::optional<std::size_t> datum;
  std::vector<bool> guessed;  ///< nodes held, loosely, at their starting value; those beyond its end are, too
  double guess_sigma_m = 0.5;
  double guess_sigma_rad = 0.035;
  double control_sigma_m = 0.002;
  bool with_covariance = true;  ///< false: for trials, which need none

  double sigma_of_m(const GraphControl& target) const { return std::hypot(control_sigma_m, target.sigma_m); }
  /// Whether control or pictures tie it to the local frame.
  bool is_tied() const { return !control.empty() || !sights.empty(); }
};

struct PoseGraphResult {
  std::vector<Pose> local_from_scan;
  std::vector<Matrix6d> covariance;  ///< of (rotation, translation) per node, local axes
  double cost = 0.0;                 ///< half the sum of squares that was minimised, after the robust losses
  std::vector<double> pair_misfit;   ///< squared residual of each pair in its own sigmas (6 are expected)
  std::vector<Eigen::Vector3d> control_residual_m;
  std::vector<Vector6d> sight_residual;  ///< picture less adjusted: rotation [rad], translation [m], local axes
  std::vector<double> sight_misfit;      ///< their squares in sigmas of the pictures (6 are expected)
  std::vector<Pose> scan_from_camera;
  std::vector<double> camera_misfit;           ///< squared move of each camera from where it was said to sit, in sigmas
  Pose moved_from_guesses = Pose::Identity();  ///< what all guesses move by to stand about the datum; without it none
};

/// Least squares with Cauchy's loss on the pairs, so that a wrong pair does not pull the rest (Ceres). Such a loss has
/// more than one minimum: it begins at the starting values and, once more, where the best known pairs chain the nodes
/// from the datum on; the less costly of both is the result. Deterministic.
PoseGraphResult solve_pose_graph(const PoseGraph& graph, Progress& progress);

}  // namespace adit
