#pragma once
// Points of a ring that do not belong to its circle.

#include <vector>

#include "core/profiling/ring_fit.h"

namespace adit {

/// Points that lie off the circle of most: of the circles through three points the one whose median residual is least
/// (Rousseeuw 1984; all triples of up to 20 points, 1000 drawn ones of more, always the same), off by more than 30 mm,
/// 2 % of the radius and three of its robust sigmas. `fit` is that of all points. None when fewer than three would be
/// left. Of five points the only one without which the other four are a circle; none of fewer: every three are one.
std::vector<std::size_t> ring_outliers(const std::vector<RingPlace>& places, const RingFit& fit,
                                       const Eigen::Vector3d& along);

}  // namespace adit
