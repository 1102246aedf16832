#include "core/registration/register_pair.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/registration/alike_along.h"
#include "core/registration/fit_check.h"
#include "core/registration/ndt.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/pair_sheet.h"
#include "core/registration/witness.h"

namespace adit {
namespace {

constexpr std::size_t along = 0;  // in direction_names

NdtOptions ndt_options(const PreparedScan& target, const PreparedScan& source, const RegistrationOptions& options) {
  NdtOptions ndt;
  ndt.coarsest_cell_m = options.cell_m;
  ndt.finest_cell_m = std::max(ndt.finest_cell_m, 8.0 * piece_of(target, source));
  ndt.sources = options.ndt_sources;
  return ndt;
}

/// By the normal distributions transform, then the surfaces; once more with a search along the tunnel where what is
/// found does not agree: another round of blasting, perhaps.
NdtAlignment aligned_at(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                        const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress) {
  NdtOptions ndt = ndt_options(target, source, options);
  NdtAlignment alignment;
  for (const double search_m : {0.0, ndt.search_m}) {
    ndt.search_m = search_m;
    const NdtAlignment found = ndt_align(target.pyramid, source.pyramid, guess, ndt, progress);
    alignment.target_from_source = refined(target, source, found.target_from_source, {}, axes, options, progress);
    alignment.iterations += found.iterations;
    if (check_fit(target, source, alignment.target_from_source).agrees()) break;
  }
  return alignment;
}

/// The same with the guess kept along the tunnel: where little tells, the transform drifts to where scans overlap most.
Pose aligned_across(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                    const Eigen::Vector3d& axis, const RegistrationOptions& options, Progress& progress) {
  NdtOptions ndt = ndt_options(target, source, options);
  ndt.search_m = 0.0;
  ndt.held_direction = axis;
  return ndt_align(target.pyramid, source.pyramid, guess, ndt, progress).target_from_source;
}

/// Where near the guess a pair fits best, if not where the transform ended.
LikestPlace likest_near(const PreparedScan& target, const PreparedScan& source, const Pose& place,
                        const AlongSearch& search, const RegistrationOptions& options, Progress& progress) {
  const bool drifted = std::abs(shift_along_m(search.guess, place, search.axis)) > search.reach_m;
  const Pose base = drifted ? aligned_across(target, source, search.guess, search.axis, options, progress) : place;
  return likest_along(target, source, place, base, search, options, progress);
}

/// Where a pair that does not agree well ends otherwise: begun on large pieces; with target and source exchanged, from
/// the guess where there is one. And where points refined it, what surfaces say.
std::vector<Pose> other_answers(const PreparedScan& target, const PreparedScan& source, const Pose& pose,
                                const std::optional<Pose>& guess, const Eigen::Matrix3d& axes,
                                const RegistrationOptions& options, Progress& progress) {
  std::vector<Pose> answers;
  if (options.refinement == Refinement::points) {  // closest points weigh surfaces that do not meet as those that do
    RegistrationOptions by_surfaces = options;
    by_surfaces.refinement = Refinement::surfaces;
    answers.push_back(refined(target, source, pose, {}, axes, by_surfaces, progress));
  }
  if (check_fit(target, source, pose).agreeing >= well_agreeing) return answers;
  answers.push_back(refined_from_large(target, source, pose, {}, axes, options, progress));
  const Pose& begun = guess ? *guess : pose;
  const Eigen::Matrix3d axes_in_source = axes * begun.linear();
  const Pose exchanged =
      guess ? aligned_at(source, target, begun.inverse(), axes_in_source, options, progress).target_from_source
            : refined(source, target, begun.inverse(), {}, axes_in_source, options, progress);
  answers.push_back(exchanged.inverse());
  return answers;
}

/// What is known of a pair beside its surfaces.
struct Known {
  HeldDirections held{};
  std::optional<Slide> slide;
  std::vector<Vector6d> other_answers;  ///< as errors
  std::vector<Stretch> apart;           ///< what stands there is no witness
};

/// A pose, judged by the surfaces that meet there.
struct Judged {
  std::vector<SurfaceMatch> matches;
  PairInformation known;
};
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

/// (rotation, translation) from one pose to another.
Vector6d difference(const Pose& from, const Pose& to) {
  Vector6d result;
  result << rotation_vector(to.linear() * from.linear().transpose()), to.translation() - from.translation();
  return result;
}

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

/// How a pair that is held along the tunnel would move along it: as to where it ends when it is held elsewhere, which
/// says more than the surfaces at one place. Between ribs it would ride on them: there it is held a rib's distance on.
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

/// What is held stands at the guess.
PoseSigma as_guessed_where_held(const PairInformation& known, const RegistrationOptions& options) {
  PoseSigma sigma = known.sigma;
  double* const moves[] = {&sigma.along_m, &sigma.across_m, &sigma.up_m};
  double* const turns[] = {&sigma.roll_rad, &sigma.pitch_rad, &sigma.yaw_rad};
  for (std::size_t i = 0; i < 3; ++i) {
    if (known.undetermined[i]) *moves[i] = options.guess_sigma_m;
    if (known.undetermined[i + 3]) *turns[i] = rad_from_deg(options.guess_sigma_deg);
  }
  return sigma;
}

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
  constexpr double least_m = 3e-4;    // of a step: less does not matter
  constexpr double most_share = 0.5;  // of what tells "along": more of it is rock on all sides
  RegistrationOptions by_surfaces = options;
  by_surfaces.refinement = Refinement::surfaces;
  const NormalEquations equations = normal_equations(outside(rest.apart, judged.matches, pose, axes),
                                                     tukey_reach_m(judged.matches, piece_of(target, source)));
  const double asked_m = axes.row(along).dot(step_without(equations, {}, axes).tail<3>()) / equations.bend();
  const double loose_m = judged.known.sigma.along_m / std::sqrt(std::max(share, 1e-3));
  double shift_m = 0.0;
  if (!last.borne_out || std::abs(asked_m) < std::max(least_m, loose_m)) {
    if (rest.apart.size() < 2 || share > most_share) return std::nullopt;
    const double guess_m = shift_along_m(pose, search.guess, search.axis);
    shift_m = likelier_shift_m(target, source, pose, search.axis, guess_m - search.reach_m, guess_m + search.reach_m,
                               rest.apart, progress);
    if (shift_m == 0.0) return std::nullopt;
  }
  Elsewhere there;
  there.pose = refined(target, source, Eigen::Translation3d(shift_m * search.axis) * pose, {}, axes, by_surfaces,
                       progress, rest.apart);
  there.judged = judge(target, source, there.pose, axes, rest, options, progress);
  return there;
}

/// The first thing that tells "along" may have moved, or the first two: whether what stands elsewhere tells the same.
/// Where nothing else tells, the first is a lone witness. Where the rest puts the scan elsewhere, it is believed, and
/// what has moved is left out; where it nearly does, that is an error.
void hear_witnesses(PairResult& pair, const PreparedScan& target, const PreparedScan& source, const AlongSearch& search,
                    Pose& pose, Judged& judged, Known& beside, const Eigen::Matrix3d& axes,
                    const RegistrationOptions& options, Progress& progress) {
  constexpr double contradicts_sigmas = 4.0;
  const double near_m = 2.0 * tukey_reach_m(judged.matches, piece_of(target, source));
  Known rest = beside;
  double share = 1.0;
  for (int heard = 0; heard < 2; ++heard) {
    const Witness witness = strongest_witness(target, source, pose, search.axis, near_m, rest.apart, progress);
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

/// With what is not determined at the guess. Ribs may be too thin to tell where along a scan stands and yet not meet
/// there: then what surfaces tell of the other directions they tell where they meet, and it stays there.
Pose held_pose(const PreparedScan& target, const PreparedScan& source, const Pose& guess, const Pose& pose,
               const HeldDirections& at_guess, const Known& beside, const PairInformation& known,
               const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress,
               const std::vector<Stretch>& moved) {
  const Pose back = put_back(guess, pose, at_guess, known.ways, axes);
  const Pose there = refined(target, source, back, beside.held, axes, options, progress, moved);
  if (!meets_worse(target, source, there, pose)) return there;
  return refined(target, source, pose, beside.held, axes, options, progress, moved);
}

/// Where the transform and the surfaces put it.
Pose placed(PairResult& pair, const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
            const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress) {
  if (start == Start::found) return refined(target, source, guess, {}, axes, options, progress);
  const NdtAlignment alignment = aligned_at(target, source, guess, axes, options, progress);
  pair.iterations = alignment.iterations;
  return alignment.target_from_source;
}

}  // namespace

PairInformation pair_information(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                                 const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                                 Progress& progress) {
  return judge(target, source, target_from_source, tunnel_axes(axis_in_target), {}, options, progress).known;
}

PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                         Progress& progress) {
  PairResult pair;
  pair.source = source.name;
  pair.target = target.name;
  const Eigen::Matrix3d axes = tunnel_axes(axis_in_target);
  Progress transform = progress.part(0.7, "");
  Progress last = progress.part(0.3, "");
  Known beside;
  Pose pose = placed(pair, target, source, guess, start, axes, options, transform);
  const AlongSearch search{axis_in_target, guess, start == Start::found ? found_reach_m : 3.0 * options.guess_sigma_m};
  if (start != Start::surveyed) {
    const LikestPlace likest = likest_near(target, source, pose, search, options, last);
    pose = likest.target_from_source;
    pair.alike_m = likest.alike_m;
    beside.slide = likest.slide;
  }
  Judged judged = judge(target, source, pose, axes, beside, options, last);
  const HeldDirections at_guess = judged.known.undetermined;
  if (at_guess[along]) {
    pair.alike_m = 0.0;  // smooth walls: what is alike there is noise
  } else if (pair.alike_m == 0.0) {
    hear_witnesses(pair, target, source, search, pose, judged, beside, axes, options, last);
  }
  std::vector<Pose> others;
  if (pair.moved.empty())
    others = other_answers(target, source, pose, start == Start::guess ? std::optional<Pose>(guess) : std::nullopt,
                           axes, options, last);
  for (const Pose& other : others) beside.other_answers.push_back(difference(pose, other));
  if (!others.empty()) judged = judge(target, source, pose, axes, beside, options, last);
  // Where it fits elsewhere as well, or one thing tells, it stays where surfaces meet: the adjustment holds it.
  beside.held = at_guess;
  beside.held[along] = at_guess[along] || pair.alike_m != 0.0 || !pair.lone_witness.is_empty();
  if (beside.held != HeldDirections{}) {
    pose = held_pose(target, source, guess, pose, at_guess, beside, judged.known, axes, options, last, pair.moved);
    judged = judge(target, source, pose, axes, beside, options, last);
    if (beside.held[along] && pair.alike_m == 0.0) {
      beside.slide = slide_of(target, source, pose, beside.held, judged.known.ways[along], axes, options, last);
      judged = judge(target, source, pose, axes, beside, options, last);
    }
  }
  pair.target_from_source = pose;
  pair.sigma = as_guessed_where_held(judged.known, options);
  pair.information = judged.known.information;
  for (std::size_t i = 0; i < beside.held.size(); ++i)
    if (judged.known.undetermined[i]) pair.undetermined.emplace_back(direction_names[i]);
  fill_sheet(pair, target, source, judged.matches, others, axes, last);
  return pair;
}

}  // namespace adit
