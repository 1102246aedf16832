#pragma once
// Had the thing that tells "along" most moved between two scans, so would the scan: the rest is heard without it.

#include "core/registration/alike_along.h"
#include "core/registration/judged_pair.h"

namespace adit {

/// The first thing that tells "along" may have moved, or the first two: whether what stands elsewhere tells the same.
/// Where nothing else tells, the first is a lone witness. Where the rest puts the scan elsewhere, it is believed, and
/// what has moved is left out; where it nearly does, that is an error.
void hear_witnesses(PairResult& pair, const PreparedScan& target, const PreparedScan& source, const AlongSearch& search,
                    Pose& pose, Judged& judged, Known& beside, const Eigen::Matrix3d& axes,
                    const RegistrationOptions& options, Progress& progress);

}  // namespace adit
