#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
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

/// A guess that moves with all others, about the datum.
struct MovingGuessCost {
  Pose start;
  Eigen::Vector3d pivot;
  double sigma_rad, sigma_m;
  template <typename T>
  bool operator()(const T* node, const T* move, T* residual) const {
    T q[4];
    ceres::AngleAxisToQuaternion(move, q);
    const Eigen::Quaternion<T> turn(q[0], q[1], q[2], q[3]);
    ceres::AngleAxisToQuaternion(node, q);
    const Eigen::Matrix<T, 3, 1> left =
        rotation_vector_of<T>(Eigen::Quaternion<T>(q[0], q[1], q[2], q[3]) * turn.conjugate());
    const Eigen::Matrix<T, 3, 1> guess = turn * Eigen::Vector3d(start.translation() - pivot).cast<T>() +
                                         pivot.cast<T>() + Eigen::Matrix<T, 3, 1>(move[3], move[4], move[5]);
    const Eigen::Matrix<T, 3, 1> off = moved(node, start) - guess;
    for (int i = 0; i < 3; ++i) {
      residual[i] = left[i] / sigma_rad;
      residual[i + 3] = off[i] / sigma_m;
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

struct SightCost {
  Pose scan_start, camera_start, measured;
  Matrix6d root;  ///< root^T root = information

  template <typename T>
  Eigen::Matrix<T, 6, 1> error(const T* scan, const T* camera) const {
    const Eigen::Quaternion<T> local_from_scan = turned(scan, scan_start);
    const Eigen::Quaternion<T> turn = local_from_scan * turned(camera, camera_start);
    Eigen::Matrix<T, 6, 1> off;
    off.template head<3>() =
        rotation_vector_of<T>(turn * Eigen::Quaterniond(measured.linear()).conjugate().template cast<T>());
    off.template tail<3>() =
        local_from_scan * moved(camera, camera_start) + moved(scan, scan_start) - measured.translation().cast<T>();
    return off;
  }

  template <typename T>
  bool operator()(const T* scan, const T* camera, T* residual) const {
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = root.cast<T>() * error(scan, camera);
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
  std::vector<Block> cameras;
  Block move{};  ///< of all guesses, about the datum
  ceres::Problem ceres;
  std::vector<PairCost> pairs;
  std::vector<SightCost> sights;
};

void add_guess(Problem& problem, const PoseGraph& graph, std::size_t node) {
  constexpr double hardly = 100.0;  // a node that nobody guessed is held by this much less, for the equations' sake
  const double looser = node < graph.guessed.size() && !graph.guessed[node] ? hardly : 1.0;
  const double sigma_rad = looser * graph.guess_sigma_rad, sigma_m = looser * graph.guess_sigma_m;
  double* const block = problem.blocks[node].data();
  if (!graph.datum || graph.datum == node) {
    problem.ceres.AddResidualBlock(
        new ceres::AutoDiffCostFunction<GuessCost, 6, 6>(new GuessCost{sigma_rad, sigma_m}), nullptr,
        graph.datum ? problem.move.data() : block);  // what the datum's guess is off is how far all others move
    return;
  }
  problem.ceres.AddResidualBlock(
      new ceres::AutoDiffCostFunction<MovingGuessCost, 6, 6, 6>(new MovingGuessCost{
          graph.local_from_scan[node], graph.local_from_scan[*graph.datum].translation(), sigma_rad, sigma_m}),
      nullptr, block, problem.move.data());
}

void add_sights(Problem& problem, const PoseGraph& graph) {
  problem.cameras.assign(graph.cameras.size(), Block{});
  for (std::size_t i = 0; i < graph.cameras.size(); ++i)
    problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<GuessCost, 6, 6>(
                                       new GuessCost{graph.cameras[i].sigma_rad, graph.cameras[i].sigma_m}),
                                   nullptr, problem.cameras[i].data());
  for (const GraphSight& sight : graph.sights) {
    const SightCost cost{graph.local_from_scan[sight.node], graph.cameras[sight.camera].scan_from_camera,
                         sight.local_from_camera, square_root(sight.information)};
    problem.sights.push_back(cost);
    problem.ceres.AddResidualBlock(new ceres::AutoDiffCostFunction<SightCost, 6, 6, 6>(new SightCost(cost)),
                                   new ceres::HuberLoss(5.0), problem.blocks[sight.node].data(),
                                   problem.cameras[sight.camera].data());
  }
}

void build(Problem& problem, const PoseGraph& graph) {
  problem.blocks.assign(graph.local_from_scan.size(), Block{});
  for (auto& block : problem.blocks) problem.ceres.AddParameterBlock(block.data(), 6);
  for (std::size_t i = 0; i < problem.blocks.size(); ++i) add_guess(problem, graph, i);
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
                                       graph.local_from_scan[c.node], c.in_scan, c.in_local, graph.sigma_of_m(c)}),
                                   new ceres::HuberLoss(4.0), problem.blocks[c.node].data());
  add_sights(problem, graph);
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

/// Minimises from where the blocks stand; the cost.
double minimised(Problem& problem, Progress& progress) {
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
  return summary.final_cost;
}

/// Where the best known pairs put the nodes, from the datum (or the node with most control) on; what none reaches
/// stays.
std::vector<Pose> chain_of(const PoseGraph& graph) {
  const std::size_t nodes = graph.local_from_scan.size();
  std::vector<std::size_t> controls(nodes, 0);
  for (const GraphControl& c : graph.control) ++controls[c.node];
  const auto most = std::max_element(controls.begin(), controls.end()) - controls.begin();
  std::vector<Pose> poses = graph.local_from_scan;
  std::vector<bool> reached(nodes, false);
  reached[graph.datum.value_or(static_cast<std::size_t>(most))] = true;
  std::vector<double> known;  // by the weakest direction
  for (const GraphPair& pair : graph.pairs)
    known.push_back(
        Eigen::SelfAdjointEigenSolver<Matrix6d>(pair.information, Eigen::EigenvaluesOnly).eigenvalues().minCoeff());
  for (;;) {
    const GraphPair* next = nullptr;
    double best = -1.0;
    for (std::size_t k = 0; k < graph.pairs.size(); ++k) {
      const GraphPair& pair = graph.pairs[k];
      if (reached[pair.source] == reached[pair.target] || known[k] <= best) continue;
      next = &pair;
      best = known[k];
    }
    if (next == nullptr) return poses;
    if (reached[next->target])
      poses[next->source] = poses[next->target] * next->target_from_source;
    else
      poses[next->target] = poses[next->source] * next->target_from_source.inverse();
    reached[next->source] = reached[next->target] = true;
  }
}

void begin_at(Problem& problem, const PoseGraph& graph, const std::vector<Pose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (graph.datum == i) continue;
    const Pose& start = graph.local_from_scan[i];
    Eigen::Map<Vector6d> block(problem.blocks[i].data());
    block << rotation_vector(poses[i].linear() * start.linear().transpose()),
        poses[i].translation() - start.translation();
  }
}

Pose moved_by(const Block& move, const Eigen::Vector3d& pivot) {
  Pose pose = Pose::Identity();
  pose.linear() = rotation_from_vector(Eigen::Vector3d(move.data()));
  pose.translation() = pivot - pose.linear() * pivot + Eigen::Vector3d(move.data() + 3);
  return pose;
}

Pose pose_of(const Block& block, const Pose& start) {
  Pose pose = Pose::Identity();
  pose.linear() = turned(block.data(), start).normalized().toRotationMatrix();
  pose.translation() = moved(block.data(), start);
  return pose;
}

void read_cameras(const Problem& problem, const PoseGraph& graph, PoseGraphResult& result) {
  for (std::size_t i = 0; i < graph.cameras.size(); ++i) {
    const GraphCamera& camera = graph.cameras[i];
    const Eigen::Map<const Vector6d> move(problem.cameras[i].data());
    result.scan_from_camera.push_back(pose_of(problem.cameras[i], camera.scan_from_camera));
    result.camera_misfit.push_back(move.head<3>().squaredNorm() / (camera.sigma_rad * camera.sigma_rad) +
                                   move.tail<3>().squaredNorm() / (camera.sigma_m * camera.sigma_m));
  }
  for (std::size_t k = 0; k < graph.sights.size(); ++k) {
    const Vector6d off = problem.sights[k].error(problem.blocks[graph.sights[k].node].data(),
                                                 problem.cameras[graph.sights[k].camera].data());
    result.sight_residual.emplace_back(-off);
    result.sight_misfit.push_back(off.dot(graph.sights[k].information * off));
  }
}

PoseGraphResult result_of(const Problem& problem, const PoseGraph& graph) {
  PoseGraphResult result;
  for (std::size_t i = 0; i < problem.blocks.size(); ++i)
    result.local_from_scan.push_back(pose_of(problem.blocks[i], graph.local_from_scan[i]));
  for (std::size_t k = 0; k < graph.pairs.size(); ++k) {
    Vector6d residual;
    problem.pairs[k](problem.blocks[graph.pairs[k].target].data(), problem.blocks[graph.pairs[k].source].data(),
                     residual.data());
    result.pair_misfit.push_back(residual.squaredNorm());
  }
  for (const GraphControl& c : graph.control)
    result.control_residual_m.emplace_back(result.local_from_scan[c.node] * c.in_scan - c.in_local);
  read_cameras(problem, graph, result);
  if (graph.datum)
    result.moved_from_guesses = moved_by(problem.move, graph.local_from_scan[*graph.datum].translation());
  return result;
}

}  // namespace

PoseGraphResult solve_pose_graph(const PoseGraph& graph, Progress& progress) {
  Problem at_start, chained;
  build(at_start, graph);
  double cost = minimised(at_start, progress);
  Problem* best = &at_start;
  if (!graph.pairs.empty()) {
    build(chained, graph);
    begin_at(chained, graph, chain_of(graph));
    const double other = minimised(chained, progress);
    constexpr double clearly = 1e-6;  // of the cost: mostly both end at one place
    if (other < cost * (1.0 - clearly)) best = &chained, cost = other;
  }
  PoseGraphResult result = result_of(*best, graph);
  result.cost = cost;
  if (graph.with_covariance) result.covariance = covariances(*best, graph);
  return result;
}

}  // namespace adit
