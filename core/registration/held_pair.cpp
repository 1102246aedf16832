#include "core/registration/held_pair.h"

#include <algorithm>
#include <cmath>

#include "core/registration/fit_check.h"
#include "core/registration/pair_refinement.h"

namespace adit {
namespace {

constexpr std::size_t along = 0;  // in direction_names

bool meets_worse(const PreparedScan& target, const PreparedScan& source, const Pose& there, const Pose& pose) {
  return check_fit(target, source, there).agreeing < check_fit(target, source, pose).agreeing - clearly_less_agreeing;
}

/// How far along a slide the most agrees: a rib's distance, where there are ribs.
double best_length_m(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const Slide& slide) {
  constexpr double least_m = 0.3, most_m = 2.5, step_m = 0.05;
  double best_m = least_m, most_agreeing = 0.0;
  for (int i = 0; least_m + i * step_m <= most_m; ++i)
    for (const double sign : {1.0, -1.0}) {
      const double length_m = sign * (least_m + i * step_m);
      const double agreeing = check_fit(target, source, slid(pose, slide, length_m)).agreeing;
      if (agreeing > most_agreeing) best_m = length_m, most_agreeing = agreeing;
    }
  return best_m;
}

/// As surfaces that hardly tell another direction ask, a scan may turn over on a metre along: no tunnel bends so.
Slide straight_unless_tunnel(const Slide& slide, const Eigen::Vector3d& axis) {
  constexpr double most_turn_per_m = 0.2, most_way_per_m = 1.5;
  const bool is_tunnel = slide.turn_rad.norm() <= most_turn_per_m && slide.shift_m.norm() <= most_way_per_m;
  return is_tunnel ? slide : Slide{Eigen::Vector3d::Zero(), axis};
}

}  // namespace

Pose held_pose(const PreparedScan& target, const PreparedScan& source, const AlongSearch& search, const Pose& pose,
               const HeldDirections& at_guess, const Known& beside, const PairInformation& known,
               const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress,
               const std::vector<Stretch>& moved) {
  const Pose back = put_back(search.guess, pose, at_guess, known.ways, axes);
  const Pose there = refined(target, source, back, beside.held, axes, options, progress, moved);
  const bool drifted = distance_between_m(search.guess, pose) > search.reach_m;
  const bool tells_the_others = !at_guess[1] && !at_guess[2] && !at_guess[4] && !at_guess[5];  // all but roll
  if (drifted || !tells_the_others || !meets_worse(target, source, there, pose)) return there;
  return refined(target, source, pose, beside.held, axes, options, progress, moved);
}

Slide slide_of(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const HeldDirections& held,
               const Slide& asked, const Eigen::Matrix3d& axes, const RegistrationOptions& options,
               Progress& progress) {
  constexpr double farthest_off_m = 0.1;  // farther from where it was to be, it has slipped
  const Slide estimate = straight_unless_tunnel(asked, axes.row(along).transpose());
  const auto held_at = [&](double length_m) -> std::optional<Pose> {
    const Pose moved = slid(pose, estimate, length_m);
    const Pose there = refined(target, source, moved, held, axes, options, progress);
    if (distance_between_m(moved, there) > farthest_off_m) return std::nullopt;
    return there;
  };
  std::optional<Pose> there = held_at(std::clamp(2.0 * options.guess_sigma_m, 0.5, 2.0));
  if (!there || meets_worse(target, source, *there, pose))
    there = held_at(best_length_m(target, source, pose, estimate));
  if (!there || meets_worse(target, source, *there, pose)) return estimate;
  return slide_between(pose, *there, axes.row(along).transpose());
}

}  // namespace adit
