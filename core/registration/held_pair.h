#pragma once
// A pair of which a direction is held: where it stands, and how it would move along the tunnel.

#include "core/registration/alike_along.h"
#include "core/registration/judged_pair.h"

namespace adit {

/// With what is not determined at the guess. Ribs may be too thin to tell where along a scan stands and yet not meet
/// there: then what surfaces tell of the other directions they tell where they meet, and it stays there; unless that is
/// farther off than guesses are.
Pose held_pose(const PreparedScan& target, const PreparedScan& source, const AlongSearch& search, const Pose& pose,
               const HeldDirections& at_guess, const Known& beside, const PairInformation& known,
               const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress,
               const std::vector<Stretch>& moved);

/// How a pair that is held along the tunnel would move along it: as to where it ends when it is held elsewhere, which
/// says more than the surfaces at one place. Between ribs it would ride on them: there it is held a rib's distance on.
Slide slide_of(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const HeldDirections& held,
               const Slide& asked, const Eigen::Matrix3d& axes, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
