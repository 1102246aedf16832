#pragma once
// Which directions do the clouds determine? Covariance in tunnel axes.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/pose.h"
#include "core/registration/registration.h"
#include "core/registration/surface_match.h"

namespace adit {

/// Rows: unit vectors along, across (to the right), up, for an axis direction [any frame with z about up].
Eigen::Matrix3d tunnel_axes(const Eigen::Vector3d& axis_direction);

/// Standard deviations in tunnel axes of a 6x6 covariance of (rotation, translation) in the frame of the axes.
PoseSigma sigma_in_axes(const Matrix6d& covariance, const Eigen::Matrix3d& axes);

/// The six ways a pose moves in a tunnel.
inline constexpr std::array<const char*, 6> direction_names{"along", "across", "up", "roll", "pitch", "yaw"};
/// True for those (by number in direction_names) that are not moved.
using HeldDirections = std::array<bool, 6>;

/// The pose moved to `to` in the held directions alone. Axes: rows as of tunnel_axes, in the target's frame.
Pose held_at(const Pose& to, const Pose& target_from_source, const HeldDirections& held, const Eigen::Matrix3d& axes);

/// The Gauss-Newton step of (rotation, translation) that leaves the held directions alone.
Vector6d step_without(const NormalEquations& equations, const HeldDirections& held, const Eigen::Matrix3d& axes);

/// How a pose moves for a metre along the tunnel, as in a curve it turns and leaves the axis; or for a metre or radian
/// in another direction, as in a round tunnel it rolls about the axis, not about the scanner. Target's frame.
struct Slide {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  ///< about the source's origin
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
};

/// The tunnel as an arc on which both poses of one scan stand, at the first of them.
Slide slide_between(const Pose& from, const Pose& to, const Eigen::Vector3d& axis);

/// The pose so far [m or rad] along that arc.
Pose slid(const Pose& pose, const Slide& slide, double length);

/// The pose moved to where `to` stands in the held directions, each along its way, so that it stays where it fits.
Pose put_back(const Pose& to, const Pose& target_from_source, const HeldDirections& held,
              const std::array<Slide, 6>& ways, const Eigen::Matrix3d& axes);

/// Information of a pair about (rotation [rad], translation [m]) in the target's frame at the source's origin, and the
/// directions in which it has none.
struct PairInformation {
  Matrix6d information = Matrix6d::Zero();  ///< next to nothing along undetermined directions
  PoseSigma sigma;                          ///< 10 m and more in undetermined directions: no number the clouds gave
  HeldDirections undetermined{};
  std::array<Slide, 6> ways;  ///< of undetermined directions: the way a metre or radian of it goes
};

struct ObservabilityLimits {
  double undetermined_sigma_m = 0.02;
  double least_sigma_m = 0.0;  ///< in each direction, beside what is measured
  double guess_sigma_m = 0.0;  ///< of what is held
  /// (rotation, translation) from here to other answers that are as good: each is an error of its own.
  std::vector<Vector6d> other_answers;
};

/// Covariance = S^-1 B S^-1 (White 1980) with S the hessian for Tukey's weights less its noise part and B the measured
/// covariance of the gradient, by cubes of 1, 2 or 4 m, whichever says most: surfaces may be bent by a scanner. A
/// direction is undetermined when its sigma, all others following (Schur complement), exceeds the limit (rotations: on
/// the radius of gyration of the matches), or when what is left of its hessian then is not three times what noise alone
/// makes. The weakest is held first, the others are judged without it. held: directions that are held already, and
/// slide: what follows "along", where the surfaces cannot say it; otherwise they do. Across and up have, beside their
/// own errors, what a tangent leaves out of a curve when "along" is off by a guess's sigma.
PairInformation judge_observability(std::span<const SurfaceMatch> matches, double tukey_m,
                                    const Eigen::Matrix3d& axes_in_target, const ObservabilityLimits& limits,
                                    const HeldDirections& held, const std::optional<Slide>& slide = {});

}  // namespace adit
