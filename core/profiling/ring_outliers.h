#pragma once
// Points of a ring that do not belong to its circle.

#include <vector>

#include "core/profiling/ring_fit.h"

namespace adit {

/// Points that lie off the circle of most: of the circles through three points the one whose median residual is least
/// (Rousseeuw 1984; all triples of up to 20 points, 1000 drawn ones of more, always the same), off by more than 30 mm
/// and three of its robust sigmas (an oval lining has large ones). `fit` is that of all points. Of five points the one
/// without which the other four fit three times better than without any other; none of fewer: every three are a circle.
/// None when fewer than three would be left.
std::vector<std::size_t> ring_outliers(const std::vector<RingPlace>& places, const RingFit& fit,
                                       const Eigen::Vector3d& along);

}  // namespace adit
