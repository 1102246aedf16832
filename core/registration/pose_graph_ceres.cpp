#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

#include "core/foundation/error.h"
#include "core/geometry/pose_step.h"
#include "core/registration/pose_graph.h"

namespace adit {
namespace {

/// A node moves by (rotation vector, translation) from its starting value: R = exp(w) R0, t = t0 + v.
using Block = std::array<double, 6>;

template <typename T>
Eigen::Quaternion<T> turned(const T* node, const Pose& start) {
  T q[4];
  ceres::AngleAxisToQuaternion(node, q);
  return Eigen::Quaternion<T>(q[0], q[1], q[2], q[3]) * Eigen::Quaterniond(start.linear()).cast<T>();
}

template <typename T>
Eigen::Matrix<T, 3, 1> moved(const T* node, const Pose& start) {
  return start.translation().cast<T>() + Eigen::Matrix<T, 3, 1>(node[3], node[4], node[5]);
}

template <typename T>
Eigen::Matrix<T, 3, 1> rotation_vector_of(const Eigen::Quaternion<T>& q) {
  const T wxyz[4] = {q.w(), q.x(), q.y(), q.z()};
  Eigen::Matrix<T, 3, 1> vector;
  ceres::QuaternionToAngleAxis(wxyz, vector.data());
  return vector;
}

struct PairCost {
  Pose target_start, source_start, measured;
  Matrix6d root;  ///< root^T root = information

  template <typename T>
  bool operator()(const T* target, const T* source, T* residual) const {
    const Eigen::Quaternion<T> target_from_local = turned(target, target_start).conjugate();
    const Eigen::Quaternion<T> turn = target_from_local * turned(source, source_start);
    const Eigen::Matrix<T, 3, 1> move = target_from_local * (moved(source, source_start) - moved(target, target_start));
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() =
        rotation_vector_of<T>(turn * Eigen::Quaterniond(measured.linear()).conjugate().template cast<T>());
    error.template tail<3>() = move - measured.translation().cast<T>();
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = root.cast<T>() * error;
    return true;
  }
};

struct GuessCost {
  double sigma_rad, sigma_m;
  template <typename T>
  bool operator()(const T* node, T* residual) const {
    for (int i = 0; i < 3; ++i) {
      residual[i] = node[i] / sigma_rad;
      residual[i + 3] = node[i + 3] / sigma_m;
    }
    return true;
  }
};

struct ControlCost {
  Pose start;
  Eigen::Vector3d in_scan, in_local;
  double sigma_m;
  template <typename T>
  bool operator()(const T* node, T* residual) const {
    Eigen::Map<Eigen::Matrix<T, 3, 1>> out(residual);
    out = (turned(node, start) * in_scan.cast<T>() + moved(node, start) - in_local.cast<T>()) / T(sigma_m);
    return true;
  }
};

/// root with root^T root = matrix, also for singular matrices.
Matrix6d square_root(const Matrix6d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(matrix);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen.eigenvectors().transpose();
}

class CancelCheck : public ceres::IterationCallback {
 public:
  explicit CancelCheck(Progress& progress) : progress_(progress) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    progress_.check();
    return ceres::SOLVER_CONTINUE;
  }

 private:
  Progress& progress_;
};

struct Problem {
  std::vector<Block> blocks;
  ceres::Problem ceres;
  std::vector<PairCost> pairs;
};

void build(Problem& problem, const PoseGraph& graph) {
  problem.blocks.assign(graph.local_from_scan.size(), Block{});
  constexpr double hardly = 100.0;  // a node that nobody guessed is held by this much less, for the equations' sake
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    auto& block = problem.blocks[i];
    const double looser = i < graph.guessed.size() && !graph.guessed[i] ? hardly : 1.0;
    problem.ceres.AddParameterBlock(block.data(), 6);
    problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<GuessCost, 6, 6>(
                                       new GuessCost{looser * graph.guess_sigma_rad, looser * graph.guess_sigma_m}),
                                   nullptr, block.data());
  }
  for (const GraphPair& pair : graph.pairs) {
    const PairCost cost{graph.local_from_scan[pair.target], graph.local_from_scan[pair.source], pair.target_from_source,
                        square_root(pair.information)};
    problem.pairs.push_back(cost);
    problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<PairCost, 6, 6, 6>(new PairCost(cost)),
                                   new ceres::CauchyLoss(4.0), problem.blocks[pair.target].data(),
                                   problem.blocks[pair.source].data());
  }
  for (const GraphControl& c : graph.control)
    problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<ControlCost, 3, 6>(new ControlCost{
                                       graph.local_from_scan[c.node], c.in_scan, c.in_local, graph.control_sigma_m}),
                                   new ceres::HuberLoss(4.0), problem.blocks[c.node].data());
  if (graph.datum) problem.ceres.SetParameterBlockConstant(problem.blocks[*graph.datum].data());
}

/// What a change of a rotation vector turns (the left Jacobian of the exponential).
Eigen::Matrix3d turn_of_change(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-6) return Eigen::Matrix3d::Identity() + 0.5 * cross_matrix(vector);
  const Eigen::Matrix3d cross = cross_matrix(vector);
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / (angle * angle) * cross +
         (angle - std::sin(angle)) / (angle * angle * angle) * cross * cross;
}

std::vector<Matrix6d> covariances(Problem& problem, const PoseGraph& graph) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.null_space_rank = -1;
  options.num_threads = 1;
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> wanted;
  for (const auto& block : problem.blocks) wanted.emplace_back(block.data(), block.data());
  if (!covariance.Compute(wanted, &problem.ceres))
    throw Error("the covariance of the adjustment could not be computed", {},
                "check poses and control points for contradictions");
  std::vector<Matrix6d> result(problem.blocks.size(), Matrix6d::Zero());
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    if (graph.datum == i) continue;
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> block;
    covariance.GetCovarianceBlock(problem.blocks[i].data(), problem.blocks[i].data(), block.data());
    Matrix6d turns = Matrix6d::Identity();
    turns.topLeftCorner<3, 3>() = turn_of_change(Eigen::Vector3d(problem.blocks[i].data()));
    result[i] = turns * block * turns.transpose();
  }
  return result;
}

}  // namespace

PoseGraphResult solve_pose_graph(const PoseGraph& graph, Progress& progress) {
  Problem problem;
  build(problem, graph);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  CancelCheck check(progress);
  options.callbacks.push_back(&check);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem.ceres, &summary);
  if (!summary.IsSolutionUsable())
    throw Error("the adjustment of the scans did not converge: " + summary.message, {},
                "check poses and control points for contradictions");

  PoseGraphResult result;
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) {
    Pose pose = Pose::Identity();
    pose.linear() = turned(problem.blocks[i].data(), graph.local_from_scan[i]).normalized().toRotationMatrix();
    pose.translation() = moved(problem.blocks[i].data(), graph.local_from_scan[i]);
    result.local_from_scan.push_back(pose);
  }
  for (std::size_t k = 0; k < graph.pairs.size(); ++k) {
    Vector6d residual;
    problem.pairs[k](problem.blocks[graph.pairs[k].target].data(), problem.blocks[graph.pairs[k].source].data(),
                     residual.data());
    result.pair_misfit.push_back(residual.squaredNorm());
  }
  for (const GraphControl& c : graph.control)
    result.control_residual_m.emplace_back(result.local_from_scan[c.node] * c.in_scan - c.in_local);
  result.cost = summary.final_cost;
  if (graph.with_covariance) result.covariance = covariances(problem, graph);
  return result;
}

}  // namespace adit
