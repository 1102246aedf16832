#include "core/registration/found_place.h"

#include "core/foundation/angle.h"
#include "core/registration/alike_along.h"
#include "core/registration/pair_refinement.h"
#include "core/registration/pair_search.h"
#include "core/registration/register_pair.h"

namespace adit {
namespace {

constexpr double least_lead = 0.15;  // of worth over the next best

PlanView plan_of(const PreparedScan& scan) {
  return plan_view(scan.pyramid.levels[scan.pyramid.level_near(0.4)]);
}

/// What a thin scan leaves open; the refinement finds the best of it.
bool same_place(const Pose& a, const Pose& b) {
  return distance_between_m(a, b) < 0.5 && rotation_between_rad(a, b) < rad_from_deg(6.0);
}

}  // namespace

PairFound found_place(const PreparedScan& target, const PreparedScan& source, const RegistrationOptions& options,
                      Progress& progress) {
  PairFound found;
  if (target.ranges.is_empty() || source.ranges.is_empty()) return found;  // nobody knows where the scanners stood
  const std::vector<PairPlace> places = search_pair(target, plan_of(target), source, plan_of(source), {}, progress);
  if (places.empty() || !places.front().check.is_enough() || !places.front().check.agrees()) return found;
  found.target_from_source = places.front().target_from_source;
  found.outcome = SearchOutcome::alike_elsewhere;
  for (const PairPlace& other : places)
    if (!same_place(other.target_from_source, found.target_from_source) &&
        other.check.worth() > places.front().check.worth() - least_lead)
      return found;
  found.target_from_source =
      refined(target, source, found.target_from_source, {}, tunnel_axes(target.axis), options, progress);
  const LikestPlace likest = likest_along(target, source, found.target_from_source, found.target_from_source,
                                          {target.axis, found.target_from_source, found_reach_m}, options, progress);
  if (likest.alike_m != 0.0) return found;
  found.target_from_source = likest.target_from_source;
  const PairInformation known =
      pair_information(target, source, found.target_from_source, target.axis, options, progress);
  found.outcome = known.undetermined == HeldDirections{} ? SearchOutcome::placed : SearchOutcome::undetermined;
  return found;
}

}  // namespace adit
