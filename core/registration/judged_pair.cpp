#include "core/registration/judged_pair.h"

#include "core/registration/pair_refinement.h"

namespace adit {

Judged judge(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const Eigen::Matrix3d& axes,
             const Known& beside, const RegistrationOptions& options, Progress& progress) {
  const SurfaceMap& surface = target.surface(piece_of(target, source));
  Judged judged;
  judged.matches = surface_matches(surface, source.surface(surface.cell_m()), pose, progress);
  const std::vector<SurfaceMatch> witnesses = outside(beside.apart, judged.matches, pose, axes);
  judged.known = judge_observability(
      witnesses, tukey_reach_m(judged.matches, surface.cell_m()), axes,
      {options.undetermined_sigma_m, options.pair_sigma_m, options.guess_sigma_m, beside.other_answers}, beside.held,
      beside.slide);
  return judged;
}

Vector6d difference(const Pose& from, const Pose& to) {
  Vector6d result;
  result << rotation_vector(to.linear() * from.linear().transpose()), to.translation() - from.translation();
  return result;
}

}  // namespace adit
