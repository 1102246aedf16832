#pragma once
// Does more than one place of the overlap say where along the tunnel a scan stands? In a smooth tunnel a machine or the
// face may be all there is; had it moved between two scans, so would the scan.

#include "core/foundation/progress.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// The stretch (4 m, or a third of a shorter overlap) that alone tells "along": the surfaces outside it slope together
/// no more than they do 0.35 m farther along. Empty where others bear it out. near_m: surfaces farther apart do not
/// meet. Axis: unit, target's frame; the stretch is measured along it from the target's origin.
Stretch lone_witness(const PreparedScan& target, const PreparedScan& source, const Pose& target_from_source,
                     const Eigen::Vector3d& axis, double near_m, Progress& progress);

}  // namespace adit
