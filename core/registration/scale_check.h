#pragma once
// Is one scan larger than the other? A wrong unit, a wrong correction of the air or of the scanner passes every other
// check.

#include <span>

#include "core/registration/surface_match.h"

namespace adit {

/// How many times the source would grow about its origin to fit the target best, its pose following.
struct ScaleCheck {
  double scale = 1.0;
  double sigma = 0.0;  ///< 0: not known, too few matches
};

/// One Gauss-Newton step of scale with Tukey's weights, the six of the pose eliminated (Frisch and Waugh 1933); sigma
/// from the spread of what cubes of 2 m say.
ScaleCheck check_scale(std::span<const SurfaceMatch> matches, double tukey_m);

}  // namespace adit
