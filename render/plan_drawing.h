#pragma once
// A plan: the axis with chainages, stations, control points and pairs, chainage to the right.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "render/canvas.h"

namespace adit::render {

/// A named place, site frame [m] (east, north).
struct PlanPlace {
  std::string name;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/// A point of the axis, site frame [m], with its chainage.
struct PlanAxisPoint {
  double chainage_m = 0.0;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
};

/// Two stations that a pair of scans ties together, site frame [m].
struct PlanTie {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  bool is_whole = true;  ///< in every direction
};

struct Plan {
  std::vector<PlanAxisPoint> axis;
  std::vector<PlanPlace> stations;
  std::vector<PlanPlace> control;
  std::vector<PlanTie> ties;
  std::vector<PlanPlace> landmarks{};  ///< coded targets that pictures show
};

/// Turned so that the axis (or, without one, the stations) runs to the right, with crosses of the site grid, a north
/// arrow and a scale bar. An empty plan says so.
void draw_plan(Canvas& canvas, const Rect& rect, const Plan& plan);

}  // namespace adit::render
