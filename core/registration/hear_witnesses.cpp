#include "core/registration/hear_witnesses.h"

#include <algorithm>
#include <cmath>

#include "core/registration/fit_check.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/witness.h"

namespace adit {
namespace {

constexpr std::size_t along = 0;  // in direction_names

/// A pose, and how it is known.
struct Elsewhere {
  Pose pose;
  Judged judged;
};

/// Where along the tunnel what stands outside the witnesses puts the scan. Nothing, where it asks for no more of a step
/// than it knows (or tells nothing here), and tells it nowhere else within reach either.
std::optional<Elsewhere> put_by_rest(const PreparedScan& target, const PreparedScan& source, const Pose& pose,
                                     const Judged& judged, const Known& rest, const Witness& last, double share,
                                     const AlongSearch& search, const Eigen::Matrix3d& axes,
                                     const RegistrationOptions& options, Progress& progress) {
  constexpr double least_m = 3e-4;      // of a step: less does not matter
  constexpr double most_reach_m = 1.5;  // farther off scans overlap less, and what is left is alike by chance
  constexpr double most_share = 0.5;    // of what tells "along": more of it is rock on all sides
  RegistrationOptions by_surfaces = options;
  by_surfaces.refinement = Refinement::surfaces;
  const NormalEquations equations = normal_equations(outside(rest.apart, judged.matches, pose, axes),
                                                     tukey_reach_m(judged.matches, piece_of(target, source)));
  const double asked_m = axes.row(along).dot(step_without(equations, {}, axes).tail<3>()) / equations.bend();
  const double loose_m = judged.known.sigma.along_m / std::sqrt(std::max(share, 1e-3));
  double shift_m = 0.0;
  if (!last.borne_out || std::abs(asked_m) < std::max(least_m, loose_m)) {
    if (rest.apart.size() < 2 || share > most_share) return std::nullopt;
    // Of walls that a scanner bends some are alike anywhere.
    if (check_fit(target, source, pose).agreeing < well_agreeing) return std::nullopt;
    const double guess_m = shift_along_m(pose, search.guess, search.axis);
    const double reach_m = std::min(search.reach_m, most_reach_m);
    shift_m =
        likelier_shift_m(target, source, pose, search.axis, guess_m - reach_m, guess_m + reach_m, rest.apart, progress);
    if (shift_m == 0.0) return std::nullopt;
  }
  Elsewhere there;
  there.pose = refined(target, source, Eigen::Translation3d(shift_m * search.axis) * pose, {}, axes, by_surfaces,
                       progress, rest.apart);
  there.judged = judge(target, source, there.pose, axes, rest, options, progress);
  return there;
}

}  // namespace

void hear_witnesses(PairResult& pair, const PreparedScan& target, const PreparedScan& source, const AlongSearch& search,
                    Pose& pose, Judged& judged, Known& beside, const Eigen::Matrix3d& axes,
                    const RegistrationOptions& options, Progress& progress) {
  constexpr double contradicts_sigmas = 4.0;
  const double near_m = 2.0 * tukey_reach_m(judged.matches, piece_of(target, source));
  const WitnessSlopes slopes = witness_slopes(target, source, pose, search.axis, near_m, progress);
  Known rest = beside;
  double share = 1.0;
  for (int heard = 0; heard < 2; ++heard) {
    const Witness witness = strongest_witness(slopes, rest.apart);
    if (!witness.borne_out && heard == 0) {
      beside.apart = {pair.lone_witness = witness.stretch};
      return;
    }
    rest.apart.push_back(witness.stretch);
    share *= 1.0 - witness.share;
    const auto there = put_by_rest(target, source, pose, judged, rest, witness, share, search, axes, options, progress);
    if (!there) continue;                           // two that tell the same bear each other out
    if (there->judged.known.undetermined[along]) {  // it does not bear the witness out, and knows no better
      pair.lone_witness = witness.stretch;
      beside.apart = rest.apart;
      return;
    }
    const double moved_m = shift_along_m(there->pose, pose, search.axis);
    const bool clear = std::abs(moved_m) >= contradicts_sigmas * there->judged.known.sigma.along_m;
    if (!clear ||
        check_fit(target, source, there->pose).agreeing < well_agreeing) {  // bent scans differ from place to place
      beside.other_answers.push_back(difference(pose, there->pose));
      judged = judge(target, source, pose, axes, beside, options, progress);
      continue;
    }
    pair.moved = rest.apart;
    pair.moved_m = moved_m;
    beside.apart = rest.apart;
    pose = there->pose;
    judged = there->judged;
    return;
  }
}

}  // namespace adit
