#pragma once
// Two scans in, one judged pair out: transform, refine, judge.

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// Overlap of a pair at a pose: share of the source's points with a target point within distance_m.
double overlap_at(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                  double distance_m);

/// Normal distributions transform from coarse cells to fine ones, then iterative closest point: point-to-plane steps
/// with Tukey's weights. axis_in_target: unit direction of the tunnel in the target's frame. Directions
/// that the clouds do not determine are put back to the guess and named.
PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
