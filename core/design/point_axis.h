#pragma once
// A plan axis through points: smooth where they stand close enough to tell the curve, straight pieces where not.

#include <Eigen/Core>

#include <vector>

#include "core/design/horizontal_alignment.h"

namespace adit {

/// What the points say of the axis. Corners split it into runs.
struct PointAxis {
  HorizontalAlignment horizontal;
  std::vector<double> chainages_m;   ///< of the points: as given, or along the axis
  std::vector<std::size_t> corners;  ///< points where it bends all at once
  bool smooth = false;               ///< pairs of arcs in all runs of three points and more; false: some are straight
  double scatter_m = 0.0;            ///< median distance of a point from the cubic through its four neighbours
  double worst_scatter_m = 0.0;      ///< likewise the greatest: noise, or points too far apart for the curve
  double sharpest_bend_rad = 0.0;    ///< at corners and between straight pieces
  double worst_advance_m = 0.0;      ///< greatest difference of an advance in chainage from the length it takes
  std::size_t worst_advance_at = 0;  ///< the point it ends at
};

/// East and north of the points in order [m]. `chainages_m`: one for each point, or empty: along the axis from
/// `start_chainage_m`. A corner is a point that bends by more than 1 degree and four times what its neighbours do. In a
/// smooth run each pair of points is joined by two arcs that meet its tangents, which come from the circle through a
/// point and its neighbours (farther ones where points scatter); a run is smooth when no point of it lies more than
/// 20 mm beside the cubic through its neighbours, else its pieces are straight. Throws Error, naming the point (counted
/// from 1), when there are fewer than two, chainages do not advance, a number is not finite, two points are one, the
/// axis turns back at one, or an advance in chainage differs by more than 50 mm from its length.
PointAxis axis_through(const std::vector<Eigen::Vector2d>& points, const std::vector<double>& chainages_m,
                       double start_chainage_m);

}  // namespace adit
