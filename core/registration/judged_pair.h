#pragma once
// A pose of a pair, and how well the surfaces that meet there know it.

#include <optional>
#include <vector>

#include "core/registration/observability.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/surface_match.h"

namespace adit {

/// What is known of a pair beside its surfaces.
struct Known {
  HeldDirections held{};
  std::optional<Slide> slide;
  std::vector<Vector6d> other_answers;  ///< as errors
  std::vector<Stretch> apart;           ///< what stands there is no witness
};

/// A pose, judged by the surfaces that meet there.
struct Judged {
  std::vector<SurfaceMatch> matches;
  PairInformation known;
};

/// Matches the surfaces at a pose and judges what they tell. Axes: rows as of tunnel_axes, in the target's frame.
Judged judge(const PreparedScan& target, const PreparedScan& source, const Pose& pose, const Eigen::Matrix3d& axes,
             const Known& beside, const RegistrationOptions& options, Progress& progress);

/// (rotation, translation) from one pose to another.
Vector6d difference(const Pose& from, const Pose& to);

}  // namespace adit
