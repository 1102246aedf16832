#pragma once
// Two scans in, one judged pair out: transform, refine, judge.

#include "core/foundation/progress.h"
#include "core/registration/observability.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// Overlap of a pair at a pose: share of the source's surface with some of the target's within distance_m.
double overlap_at(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                  double distance_m);

/// By surfaces: Gauss-Newton steps on those of both scans, first on pieces twice as large, until they are too small to
/// matter; Tukey's weights of a reach that fits the noise found. By points: iterative closest point on the middles of
/// the same pieces. Held directions (axes: tunnel_axes in the target's frame) are left alone.
Pose refined(const PreparedScan& target, const PreparedScan& source, Pose target_from_source,
             const HeldDirections& held, const Eigen::Matrix3d& axes, const RegistrationOptions& options,
             Progress& progress);

/// One step by surfaces, on the smaller pieces; nothing where too few of them meet.
std::optional<Pose> one_step(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const HeldDirections& held, const Eigen::Matrix3d& axes, Progress& progress);

/// What the surfaces of a pair say about its pose there.
PairInformation pair_information(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                                 const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options,
                                 Progress& progress);

/// Normal distributions transform from coarse cells to fine ones, then iterative closest point between the surfaces.
/// axis_in_target: unit direction of the tunnel in the target's frame. Directions that the clouds do not determine are
/// put back to the guess and named. A start that a search has found (centimetres off) is refined only.
enum class Start { guess, found };
PairResult register_pair(const PreparedScan& target, const PreparedScan& source, const Pose& guess, Start start,
                         const Eigen::Vector3d& axis_in_target, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
