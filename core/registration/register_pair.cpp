#include "core/registration/register_pair.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/angle.h"
#include "core/registration/alike_along.h"
#include "core/registration/fit_check.h"
#include "core/registration/hear_witnesses.h"
#include "core/registration/held_pair.h"
#include "core/registration/ndt.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/pair_sheet.h"

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
    pose = held_pose(target, source, search, pose, at_guess, beside, judged.known, axes, options, last, pair.moved);
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
