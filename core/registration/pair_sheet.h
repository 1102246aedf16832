#pragma once
// The quality sheet of a pair: how well two scans fit, in numbers for people.

#include <span>

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"
#include "core/registration/surface_match.h"

namespace adit {

/// Share of the source's surface with some of the target's within the distance.
double overlap_at(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                  double distance_m);

/// Residuals, balance, scale and fit at the pair's transform, where the matches are. other_answers: where the pair
/// ended when it was asked otherwise. Axes: tunnel_axes in the target's frame.
void fill_sheet(PairResult& pair, const PreparedScan& target, const PreparedScan& source,
                std::span<const SurfaceMatch> matches, std::span<const Pose> other_answers, const Eigen::Matrix3d& axes,
                Progress& progress);

}  // namespace adit
