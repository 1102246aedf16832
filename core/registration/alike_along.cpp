#include "core/registration/alike_along.h"

#include <algorithm>
#include <cmath>

#include "core/foundation/parallel.h"
#include "core/geometry/statistics.h"
#include "core/registration/fit_check.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/slope_likeness.h"

namespace adit {
namespace {

constexpr double step_m = 0.1;
constexpr double wide_m = 0.1;  // so that no step misses a place between two of them
constexpr double same_place_m = 0.15;
constexpr double like = 0.5;           // of the greatest likeness; it changes with the overlap
constexpr double least_lead = 0.15;    // of worth
constexpr double clearly_wider = 1.3;  // ribs repeat, the rock between them does not: the residuals tell
constexpr std::size_t most_places = 4;

struct PlaceAlong {
  Pose target_from_source;
  double along_m = 0.0;  ///< from the guess
  double likeness = 0.0;
  FitCheck fit;
  double spread_m = 0.0;  ///< of the residuals
};

double likeness_at(const SurfaceMap& target, const SurfaceMap& source, const Pose& pose, const Eigen::Vector3d& axis,
                   double near_m, std::size_t enough) {
  return slopes_along(target, source, pose, axis, near_m, enough).all().likeness();
}

/// Shifts of the base about which the pair is likest; the likest first.
std::vector<double> likely_shifts(const SurfaceMap& target, const SurfaceMap& source, const Pose& base,
                                  const AlongSearch& search, Progress& progress) {
  constexpr std::size_t enough_pieces = 1000;
  const double first_m = shift_along_m(base, search.guess, search.axis) - search.reach_m;
  std::vector<double> likeness(static_cast<std::size_t>(2.0 * search.reach_m / step_m) + 1);
  const auto shift_of = [&](std::size_t i) { return first_m + step_m * static_cast<double>(i); };
  parallel_for_each_index(
      likeness.size(),
      [&](std::size_t i) {
        progress.check();
        const Pose moved = Eigen::Translation3d(shift_of(i) * search.axis) * base;
        likeness[i] = likeness_at(target, source, moved, search.axis, wide_m, enough_pieces);
      },
      1);
  const double least = std::max(least_likeness, like * *std::max_element(likeness.begin(), likeness.end()));
  std::vector<std::size_t> peaks;
  for (std::size_t i = 0; i < likeness.size(); ++i) {
    const bool higher =
        (i == 0 || likeness[i] >= likeness[i - 1]) && (i + 1 == likeness.size() || likeness[i] >= likeness[i + 1]);
    if (higher && likeness[i] >= least) peaks.push_back(i);
  }
  std::stable_sort(peaks.begin(), peaks.end(), [&](auto a, auto b) { return likeness[a] > likeness[b]; });
  std::vector<double> shifts;
  for (const std::size_t i : peaks) shifts.push_back(shift_of(i));
  return shifts;
}

/// Likeness that comes from the tunnel's bends and grade and from an axis that is not quite its: it is there beside the
/// places too.
double likeness_beside(const SurfaceMap& target, const SurfaceMap& source, const std::vector<PlaceAlong>& places,
                       const Eigen::Vector3d& axis, double near_m) {
  std::vector<double> beside;
  for (const PlaceAlong& place : places)
    for (const double shift_m : {-0.35, 0.35}) {
      const Pose moved = Eigen::Translation3d(shift_m * axis) * place.target_from_source;
      beside.push_back(likeness_at(target, source, moved, axis, near_m, enough_slopes));
    }
  return median(beside);
}

/// The place itself, and those to which the likely shifts lead.
std::vector<PlaceAlong> places_along(const PreparedScan& target, const PreparedScan& source, const Pose& place,
                                     const Pose& base, const AlongSearch& search, const RegistrationOptions& options,
                                     Progress& progress) {
  const double fine_m = piece_of(target, source), coarse_m = 2.0 * fine_m;
  const SurfaceMap& fine_target = target.surface(fine_m);
  const SurfaceMap& fine_source = source.surface(fine_m);
  const double near_m = 2.0 * tukey_reach_m(surface_matches(fine_target, fine_source, place, progress), fine_m);
  std::vector<PlaceAlong> places;
  const auto is_new = [&](double along_m) {
    return std::none_of(places.begin(), places.end(),
                        [&](const PlaceAlong& known) { return std::abs(known.along_m - along_m) <= same_place_m; });
  };
  const auto add = [&](const Pose& pose) {
    const double along_m = shift_along_m(search.guess, pose, search.axis);
    if (is_new(along_m))
      places.push_back(
          {pose, along_m, likeness_at(fine_target, fine_source, pose, search.axis, near_m, enough_slopes), {}, 0.0});
  };
  add(place);
  const double base_m = shift_along_m(search.guess, base, search.axis);
  for (const double shift_m :
       likely_shifts(target.surface(coarse_m), source.surface(coarse_m), base, search, progress)) {
    if (places.size() > most_places) break;
    if (!is_new(base_m + shift_m)) continue;
    const Pose moved = Eigen::Translation3d(shift_m * search.axis) * base;
    add(refined(target, source, moved, {}, tunnel_axes(search.axis), options, progress));
  }
  if (places.size() == 1) return places;
  const double anywhere = std::max(0.0, likeness_beside(fine_target, fine_source, places, search.axis, near_m));
  for (PlaceAlong& one : places) one.likeness -= anywhere;
  return places;
}

void judge(std::vector<PlaceAlong>& places, const PreparedScan& target, const PreparedScan& source,
           Progress& progress) {
  const double fine_m = piece_of(target, source);
  for (PlaceAlong& one : places) {
    one.fit = check_fit(target, source, one.target_from_source);
    one.spread_m = tukey_reach_m(surface_matches(target.surface(fine_m), source.surface(fine_m), one.target_from_source,
                                                 progress, enough_slopes),
                                 fine_m);
  }
}

/// Those that fit as well as the best one does. A place beyond reach is no measure for those within that agree: it may
/// be where the transform drifted to, the more alike as it overlaps more.
std::vector<PlaceAlong> the_likest(std::vector<PlaceAlong> places, double reach_m) {
  const auto is_near = [&](const PlaceAlong& one) { return std::abs(one.along_m) <= reach_m && one.fit.agrees(); };
  const bool any_near = std::any_of(places.begin(), places.end(), is_near);
  const auto best_of = [&](const auto& number) {
    double best = -1e300;
    for (const PlaceAlong& one : places)
      if (!any_near || is_near(one)) best = std::max(best, number(one));
    return best;
  };
  const auto likeness = [](const PlaceAlong& one) { return one.likeness; };
  const auto worth = [](const PlaceAlong& one) { return one.fit.worth(); };
  const auto tightness = [](const PlaceAlong& one) { return 1.0 / one.spread_m; };
  const double least_alike = like * best_of(likeness);
  std::erase_if(places, [&](const PlaceAlong& one) { return one.likeness < least_alike; });
  const double least_worth = best_of(worth) - least_lead;
  std::erase_if(places, [&](const PlaceAlong& one) { return worth(one) < least_worth; });
  const double least_tightness = best_of(tightness) / clearly_wider;
  std::erase_if(places, [&](const PlaceAlong& one) { return tightness(one) < least_tightness; });
  return places;
}

}  // namespace

double shift_along_m(const Pose& from, const Pose& to, const Eigen::Vector3d& axis) {
  return axis.dot(to.translation() - from.translation());
}

LikestPlace likest_along(const PreparedScan& target, const PreparedScan& source, const Pose& place, const Pose& base,
                         const AlongSearch& search, const RegistrationOptions& options, Progress& progress) {
  std::vector<PlaceAlong> places = places_along(target, source, place, base, search, options, progress);
  const double likeness = std::max_element(places.begin(), places.end(), [](const PlaceAlong& a, const PlaceAlong& b) {
                            return a.likeness < b.likeness;
                          })->likeness;
  if (likeness < least_likeness || places.size() == 1) return {place, 0.0, {}};  // nothing tells: for others to say
  judge(places, target, source, progress);
  places = the_likest(std::move(places), search.reach_m);
  const auto nearer = [](double m) {
    return [m](const PlaceAlong& a, const PlaceAlong& b) { return std::abs(a.along_m - m) < std::abs(b.along_m - m); };
  };
  std::sort(places.begin(), places.end(), nearer(0.0));
  const PlaceAlong& chosen = places.front();
  if (places.size() == 1) return {chosen.target_from_source, 0.0, {}};
  const auto next = std::min_element(places.begin() + 1, places.end(), nearer(chosen.along_m));
  return {chosen.target_from_source, next->along_m - chosen.along_m,
          slide_between(chosen.target_from_source, next->target_from_source, search.axis)};
}

}  // namespace adit
