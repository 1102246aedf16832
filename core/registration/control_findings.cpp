#include "core/registration/control_findings.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/foundation/angle.h"
#include "core/geometry/pose_step.h"
#include "core/geometry/statistics.h"

namespace adit {
namespace {

constexpr double huber_sigmas = 4.0;       // as in the adjustment
constexpr double least_redundancy = 0.01;  // of less, a residual is rounding
constexpr double hardly_checked = 0.1;

/// What of a target's errors shows in its residual: I - w J C J^T / sigma^2 with the weight w that Huber's loss left
/// it.
Eigen::Matrix3d redundancy_of(const Pose& local_from_scan, const Matrix6d& covariance, const Eigen::Vector3d& in_scan,
                              double residual_m, double sigma_m) {
  const double weight = std::min(1.0, huber_sigmas * sigma_m / std::max(residual_m, 1e-12));
  Eigen::Matrix<double, 3, 6> j;
  j << -cross_matrix(local_from_scan.linear() * in_scan), Eigen::Matrix3d::Identity();
  return Eigen::Matrix3d::Identity() - weight * (j * covariance * j.transpose()) / (sigma_m * sigma_m);
}

/// The direction of a target that least else checks.
struct LeastChecked {
  std::string target;
  double sigma_m = 0.0;  ///< its own
  double redundancy = 1.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

void keep_least(LeastChecked& least, const std::string& target, double sigma_m, const Eigen::Matrix3d& redundancy) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(redundancy);
  if (solver.eigenvalues()[0] >= least.redundancy) return;
  least = {target, sigma_m, solver.eigenvalues()[0], solver.eigenvectors().col(0)};
}

/// What is not found by Baarda's test (4.13 sigmas for 0.1 % and 80 %) is less than this.
void report_least_checked(const LeastChecked& least, Findings& findings) {
  if (least.redundancy >= hardly_checked) return;
  Eigen::Index axis = 0;
  least.direction.cwiseAbs().maxCoeff(&axis);
  const char* const words_of[] = {"east", "north", "height"};
  const double hidden_m = 4.13 * least.sigma_m / std::sqrt(std::max(least.redundancy, least_redundancy));
  char words[200];
  std::snprintf(words, sizeof words,
                "hardly anything else checks its %s (redundancy %.2f): an error of %.0f mm and more there may not be "
                "seen, and turns or moves scans",
                words_of[axis], std::max(0.0, least.redundancy), 1000.0 * hidden_m);
  findings.push_back({Severity::warning, "control point " + least.target, words,
                      "survey more targets, away from the line of the others"});
}

void report_blunder(const std::string& scan, const ControlResidual& residual, Findings& findings) {
  char words[200];
  std::snprintf(words, sizeof words, "residual of %.1f mm at target %s: %.1f times what its sigma explains",
                1000.0 * residual.residual_m.norm(), residual.id.c_str(), residual.normalised);
  findings.push_back({Severity::decision, "scan " + scan, words, "check this target and its control point"});
}

/// How far all scans with a guess stand from it, if all do one way; and so for how they are turned.
struct CommonMove {
  std::size_t scans = 0;
  Eigen::Vector3d move_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  bool moved_alike = true;
  bool turned_alike = true;
};

CommonMove common_move(const RegistrationResult& result, const std::vector<Node>& nodes,
                       const RegistrationOptions& options) {
  CommonMove common;
  std::vector<Eigen::Vector3d> moves;
  std::vector<Eigen::Matrix3d> turns;
  for (const Node& node : nodes) {
    if (node.by != Node::By::guess) continue;
    const Pose& placed = result.scans[node.scan].local_from_scan;
    moves.emplace_back(placed.translation() - node.start.translation());
    turns.emplace_back(placed.linear() * node.start.linear().transpose());
  }
  common.scans = moves.size();
  if (moves.empty()) return common;
  for (const Eigen::Vector3d& move : moves) common.move_m += move / static_cast<double>(moves.size());
  // Half a turn has two signs: turns are averaged from the first one.
  Eigen::Vector3d from_first = Eigen::Vector3d::Zero();
  for (const Eigen::Matrix3d& turn : turns)
    from_first += rotation_vector(turn * turns.front().transpose()) / static_cast<double>(turns.size());
  const Eigen::Matrix3d mean = rotation_from_vector(from_first) * turns.front();
  common.turn_rad = rotation_vector(mean);
  for (const Eigen::Vector3d& move : moves)
    common.moved_alike = common.moved_alike && (move - common.move_m).norm() <= 3.0 * options.guess_sigma_m;
  for (const Eigen::Matrix3d& turn : turns)
    common.turned_alike = common.turned_alike && rotation_vector(turn * mean.transpose()).norm() <=
                                                     3.0 * rad_from_deg(options.guess_sigma_deg);
  return common;
}

}  // namespace

void report_control(RegistrationResult& result, const Adjustment& adjustment, const PoseGraphResult& solved,
                    const PoseGraph& graph, const std::vector<Node>& nodes) {
  std::vector<double> components;
  LeastChecked least;
  for (std::size_t k = 0; k < graph.control.size(); ++k) {
    const GraphControl& control = graph.control[k];
    const std::string& name = nodes[control.node].prepared->name;
    const Eigen::Vector3d residual = solved.local_from_scan[control.node] * control.in_scan - control.in_local;
    result.control.push_back({name, control.id, residual, adjustment.control_used[k]});
    if (!adjustment.control_used[k]) continue;
    for (const double component : residual) components.push_back(component);
    ControlResidual& reported = result.control.back();
    const double sigma_m = graph.sigma_of_m(control);
    const Eigen::Matrix3d of_errors =
        redundancy_of(solved.local_from_scan[control.node], solved.covariance[control.node], control.in_scan,
                      residual.norm(), sigma_m);
    keep_least(least, control.id, sigma_m, of_errors);
    const Eigen::Vector3d redundancy = of_errors.diagonal().cwiseMax(0.0).cwiseMin(1.0);
    reported.redundancy = redundancy.mean();
    const Eigen::Vector3d in_sigmas = residual.array() / (sigma_m * redundancy.array().max(least_redundancy).sqrt());
    reported.normalised = std::max(in_sigmas.cwiseAbs().maxCoeff(), 8.0 / 9.0 * in_sigmas.norm());
    if (reported.normalised > wrong_normalised) report_blunder(name, reported, result.findings);
  }
  report_least_checked(least, result.findings);
  result.control_rms_m = components.empty() ? 0.0 : root_mean_square(components);
  // The test of the whole (Baarda 1968): what is wrong a little everywhere fails no test of one target.
  constexpr double most_factor = 1.5;
  if (components.empty() || result.sigma_factor <= most_factor) return;
  char words[160];
  std::snprintf(words, sizeof words, "control and scans contradict one another %.1f times beyond their sigmas",
                result.sigma_factor);
  result.findings.push_back({Severity::decision, "adjustment", words,
                             "check the scale of the control (grid or ground distances), its points and "
                             "registration.control_sigma_m"});
}

void compare_guesses_with_control(RegistrationResult& result, const std::vector<Node>& nodes,
                                  const RegistrationOptions& options) {
  constexpr std::size_t most_alone = 4;  // guesses from one plan share its errors: their mean is no better than of four
  const bool controlled = std::any_of(nodes.begin(), nodes.end(), [](const Node& n) { return n.is_tied(); });
  const CommonMove common = common_move(result, nodes, options);
  if (!controlled || common.scans < 2) return;
  const double loose = 3.0 / std::sqrt(static_cast<double>(std::min(common.scans, most_alone)));
  const double turn_deg = deg_from_rad(common.turn_rad.norm());
  const bool moved = common.moved_alike && common.move_m.norm() > loose * options.guess_sigma_m;
  const bool turned = common.turned_alike && turn_deg > loose * options.guess_sigma_deg;
  if (!moved && !turned) return;
  char words[200];
  if (turned)
    std::snprintf(
        words, sizeof words,
        "all %zu scans with a guess stand turned by %.1f degrees from it, one way: control and guesses are not "
        "of one place",
        common.scans, turn_deg);
  else
    std::snprintf(words, sizeof words,
                  "all %zu scans with a guess stand %.1f m from it, one way: control and guesses are not of one place",
                  common.scans, common.move_m.norm());
  result.findings.push_back(
      {Severity::decision, "control", words, "check the coordinates in the control file and the poses in job.json"});
}

}  // namespace adit
