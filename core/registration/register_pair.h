#pragma once
// Two scans in, one judged pair out: transform, refine, judge.

#include "core/foundation/progress.h"
#include "core/registration/observability.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// What the surfaces of a pair say about its pose there.
PairInformation pair_information(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                                 const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                                 Progress& progress);

/// Normal distributions transform from coarse cells to fine ones, then iterative closest point between the surfaces.
/// axis_in_target: unit direction of the tunnel in the target's frame. Directions that the clouds do not determine are
/// put back to the guess and named. "Along" is so, too, where the pair fits as well elsewhere near (alike_along.h:
/// within three sigmas of a guess, ten metres of a place that was found) and where one thing alone tells it
/// (witness.h). Pairs that do not agree well are asked twice more; what differs is an error of theirs.
enum class Start {
  guess,    ///< as good as the options say
  found,    ///< by a search, centimetres off: is refined only
  surveyed  ///< by targets in both scans
};
PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
