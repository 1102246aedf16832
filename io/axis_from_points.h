#pragma once
// An axis of a file that holds nothing but its points.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "io/axis_file.h"

namespace adit::io {

/// Points in order, as a file gives them. Chainages and elevations: none, or one for each point.
struct ListedPoints {
  std::vector<Eigen::Vector2d> plan;  ///< east, north [m]
  std::vector<double> chainages_m;
  std::vector<double> elevations_m;
};

/// Their axis (core/design/point_axis.h), with straight grades between elevations. `start_chainage_m` is that of the
/// first point; it is needed when the points have no chainages, and refused when they do. What goes wrong becomes the
/// axis's refusal, with the file.
AxisOfFile axis_from_points(const std::string& name, const ListedPoints& points,
                            const std::optional<double>& start_chainage_m, const std::string& file);

}  // namespace adit::io
