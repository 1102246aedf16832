#pragma once
// The as-built outline at one chainage and what it says about each design line.

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

#include "core/design/section_plane.h"
#include "core/profiling/deviation_map.h"

namespace adit {

/// A point of the as-built outline in the section plane.
struct OutlinePoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< x right, z up [m], looking up-chainage
  double p_m = 0.0;
  double deviation_m = 0.0;  ///< from the profile (offset 0)
  CellKind kind = CellKind::measured;
  Eigen::Vector2d normal = Eigen::Vector2d::UnitY();  ///< of the profile there, outward
};

/// What an outline says about one design line. Numbers never stand without their line and coverage.
struct SectionAreas {
  std::string line;
  double line_offset_m = 0.0;  ///< at this chainage
  double design_area_m2 = 0.0;
  double area_m2 = 0.0;  ///< inside the as-built outline; where nothing was seen it follows the line
  double overbreak_m2 = 0.0;
  double underbreak_m2 = 0.0;
  double max_overbreak_m = 0.0;
  double max_overbreak_p_m = 0.0;  ///< where along the line
  double max_underbreak_m = 0.0;
  double max_underbreak_p_m = 0.0;
  double coverage = 0.0;      ///< share of the line that was measured, openings left out
  double interpolated = 0.0;  ///< share of the line interpolated over gaps
};

/// A piece of the line without rock within reach, from p to p, clockwise: a cross-cut, a deep niche. Never closed by a
/// guess: areas there end at the line.
struct LineOpening {
  double p_from_m = 0.0;
  double p_to_m = 0.0;
};

/// The best circle of a section whose profile is one (core/profiling/section_circle.h).
struct SectionCircle {
  bool there = false;
  Eigen::Vector2d center = Eigen::Vector2d::Zero();       ///< offset, height
  Eigen::Vector2d deviation_m = Eigen::Vector2d::Zero();  ///< of the centre from the design's: right and up positive
  double radius_m = 0.0;
  double design_radius_m = 0.0;
  /// Largest less smallest diameter of the best ellipse, and where the largest points (0 to 180 degrees, clockwise from
  /// the crown); not a number where less than 210 degrees were measured.
  double ovality_m = std::numeric_limits<double>::quiet_NaN();
  double major_clock_deg = std::numeric_limits<double>::quiet_NaN();
  double rms_m = 0.0;
  double covered_deg = 0.0;
  double sigma_center_m = 0.0;  ///< one sigma, the worse direction
  double sigma_radius_m = 0.0;
};

struct Section {
  SectionPlane plane = SectionPlane::vertical;
  double chainage_m = 0.0;                              ///< internal
  double station_m = 0.0;                               ///< displayed
  Eigen::Vector3d axis_site = Eigen::Vector3d::Zero();  ///< east, north, elevation of the axis
  std::vector<OutlinePoint> outline;                    ///< closed, clockwise looking up-chainage
  std::vector<SectionAreas> lines;  ///< one for each design line but clearance lines, the first is the reference
  std::vector<LineOpening> openings;
  SectionCircle circle;
};

}  // namespace adit
