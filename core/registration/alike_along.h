#pragma once
// Ribs, arches and rings repeat along a tunnel: where else does a pair fit as well?

#include "core/foundation/progress.h"
#include "core/registration/observability.h"
#include "core/registration/prepared_scan.h"
#include "core/registration/registration.h"

namespace adit {

/// Where along the tunnel a pair fits best.
struct LikestPlace {
  Pose target_from_source = Pose::Identity();  ///< of several that are alike, the nearest to the guess
  double alike_m = 0.0;        ///< how far from there along the axis the nearest place is that it fits as well; 0: none
  std::optional<Slide> slide;  ///< towards that place
};

/// Where to look: along a unit direction (target's frame), so far to both sides of a guess.
struct AlongSearch {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  Pose guess = Pose::Identity();
  double reach_m = 0.0;
};

/// How far to look about a place that a search found: no guess says which of two alike ones is right.
inline constexpr double found_reach_m = 10.0;

/// How far along the axis [m] the second pose stands from the first.
double shift_along_m(const Pose& from, const Pose& to, const Eigen::Vector3d& axis);

/// Compares a place with those within reach by the correlation of both surfaces' slopes along the axis, where they lie
/// on each other: 1 for the same surface, about 0 for smooth walls and for rock elsewhere. Looks every 0.1 m at a
/// thousand pieces, shifting `base` (the place itself, or another near the guess but for its shift), and refines the
/// likest four places. Alike: half the best correlation (it changes with the overlap), a worth (FitCheck) within 0.15,
/// and residuals that spread at most 1.3 times as far; best of those within reach where any of them agrees.
LikestPlace likest_along(const PreparedScan& target, const PreparedScan& source, const Pose& place, const Pose& base,
                         const AlongSearch& search, const RegistrationOptions& options, Progress& progress);

}  // namespace adit
