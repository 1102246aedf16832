#include "core/registration/joint_refinement.h"

#include <algorithm>

#include "core/foundation/parallel.h"
#include "core/registration/fit_check.h"
#include "core/registration/observability.h"
#include "core/registration/pair_refinement.h"

namespace adit {
namespace {

constexpr int most_turns = 3;
constexpr double still_m = 1e-5;
constexpr double farthest_m = 0.1;

HeldDirections held_directions(const std::vector<std::string>& undetermined) {
  HeldDirections held{};
  for (std::size_t i = 0; i < held.size(); ++i)
    held[i] = std::find(undetermined.begin(), undetermined.end(), direction_names[i]) != undetermined.end();
  return held;
}

double farthest_move_m(const PoseGraphResult& before, const PoseGraphResult& after) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < before.local_from_scan.size(); ++i)
    farthest = std::max(farthest, distance_between_m(before.local_from_scan[i], after.local_from_scan[i]));
  return farthest;
}

/// What is held along the tunnel went back to its guess: ribs and rock may not meet there.
bool still_meets(const PairResult& pair, const PreparedScan& target, const PreparedScan& source, const Pose& now) {
  return check_fit(target, source, now).agreeing >= pair.agreeing - clearly_less_agreeing;
}

}  // namespace

JointRefinement refine_jointly(const PoseGraph& graph, const Adjustment& adjustment, const std::vector<Node>& nodes,
                               const std::vector<PairResult>& pairs, const RegistrationContext& context,
                               Progress& progress) {
  JointRefinement joint{used_part(graph, adjustment), adjustment.solved};
  std::vector<HeldDirections> held;
  std::vector<const PairResult*> of;
  std::vector<std::vector<Stretch>> apart;
  for (const PairResult& pair : pairs) {
    if (!pair.used) continue;
    held.push_back(held_directions(pair.undetermined));
    of.push_back(&pair);
    apart.push_back(pair.moved);
    if (!pair.lone_witness.is_empty()) apart.back().push_back(pair.lone_witness);
  }
  for (int turn = 0; turn < most_turns; ++turn) {
    progress.step(static_cast<std::size_t>(turn), most_turns);
    parallel_for_each_index(
        joint.graph.pairs.size(),
        [&](std::size_t k) {
          if (of[k]->alike_m != 0.0) return;
          GraphPair& pair = joint.graph.pairs[k];
          const Node& target = nodes[pair.target];
          const Pose now =
              joint.solved.local_from_scan[pair.target].inverse() * joint.solved.local_from_scan[pair.source];
          const Eigen::Vector3d axis = target.start.linear().transpose() * axis_at(context, target, target.start);
          const bool knows_all = held[k] == HeldDirections{};
          if (knows_all && distance_between_m(now, pair.target_from_source) > farthest_m) return;  // it has slipped
          if (!knows_all && !still_meets(*of[k], *target.prepared, *nodes[pair.source].prepared, now)) return;
          if (const auto asked = one_step(*target.prepared, *nodes[pair.source].prepared, now, held[k],
                                          tunnel_axes(axis), apart[k], progress))
            pair.target_from_source = *asked;
        },
        1);
    PoseGraphResult solved = solve_pose_graph(joint.graph, progress);
    const double moved_m = farthest_move_m(joint.solved, solved);
    joint.solved = std::move(solved);
    if (moved_m < still_m) break;
  }
  return joint;
}

}  // namespace adit
