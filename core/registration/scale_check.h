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

/// By steps of the pose's six and of scale together, reweighted by Tukey's weights until they rest; sigma from the
/// spread of what cubes of 2 m pull.
ScaleCheck check_scale(std::span<const SurfaceMatch> matches, double tukey_m);

}  // namespace adit
