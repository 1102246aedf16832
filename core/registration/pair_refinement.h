#pragma once
// The last steps of a pair: one scan's surfaces laid on the other's.

#include <optional>
#include <span>
#include <vector>

#include "core/foundation/progress.h"
#include "core/registration/observability.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// Both scans are to hold enough points in a piece.
double piece_of(const PreparedScan& target, const PreparedScan& source);

/// Reach of Tukey's weights, for the noise found in the overlap. A wider one (4.685 sigma) would use clean noise a
/// little better, but where a scanner bends the walls, as real ones do, it averages what does not belong together: on
/// the real corridor the pairs then leave a loop 0.16 m open instead of 0.03 m.
double tukey_reach_m(std::span<const SurfaceMatch> matches, double cell_m);

/// By surfaces: Gauss-Newton steps on those of both scans, first on pieces twice as large, until they are too small to
/// matter; Tukey's weights of a reach that fits the noise found. By points: iterative closest point on the middles of
/// the same pieces. Held directions (axes: tunnel_axes in the target's frame) are left alone.
/// By surfaces, what stands in the stretches that are set apart (from the target's origin along the axis) is not asked.
Pose refined(const PreparedScan& target, const PreparedScan& source, Pose target_from_source,
             const HeldDirections& held, const Eigen::Matrix3d& axes, const RegistrationOptions& options,
             Progress& progress, std::span<const Stretch> apart = {});

/// The same, begun on pieces four times as large.
Pose refined_from_large(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                        const HeldDirections& held, const Eigen::Matrix3d& axes, const RegistrationOptions& options,
                        Progress& progress);

/// One step by surfaces, on the smaller pieces; nothing where too few of them meet.
std::optional<Pose> one_step(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const HeldDirections& held, const Eigen::Matrix3d& axes, std::span<const Stretch> apart,
                             Progress& progress);

/// Matches at a pose but those that stand in a stretch. Axes: tunnel_axes in the target's frame.
std::vector<SurfaceMatch> outside(std::span<const Stretch> apart, std::vector<SurfaceMatch> matches,
                                  const Pose& target_from_source, const Eigen::Matrix3d& axes);

}  // namespace adit
