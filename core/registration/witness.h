#pragma once
// Does more than one place of the overlap say where along the tunnel a scan stands? A machine or the face may be what
// tells most, or all there is in a smooth tunnel; had it moved between two scans, so would the scan.

#include <span>

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"
#include "core/registration/slope_likeness.h"

namespace adit {

/// The stretch of the tunnel (4 m, or a third of a shorter overlap) that tells "along" most.
struct Witness {
  Stretch stretch;         ///< along the axis from the target's origin
  double share = 0.0;      ///< of all that tells
  bool borne_out = false;  ///< the surfaces outside it slope together more than they do 0.35 m farther along
};

/// How surfaces slope together where a pair stands and beside it, stretch by stretch.
struct WitnessSlopes {
  SlopesAlong here, before, behind;  ///< before and behind: 0.35 m back and on along the axis
};

/// near_m: surfaces farther apart do not meet. Axis: unit, target's frame.
WitnessSlopes witness_slopes(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                             const Eigen::Vector3d& axis, double near_m, Progress& progress);

/// apart: stretches that are not asked.
Witness strongest_witness(const WitnessSlopes& slopes, std::span<const Stretch> apart);

/// How far on along the axis clearly more of what stands outside some stretches is alike than here, by length and not
/// by how much it tells: what moved stands in few places, and tells most. 0: nowhere. Looks every 0.1 m from one shift
/// to another.
double likelier_shift_m(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                        const Eigen::Vector3d& axis, double from_m, double to_m, std::span<const Stretch> apart,
                        Progress& progress);

}  // namespace adit
