#pragma once
// Units and placement of an IFC file.

#include <Eigen/Geometry>

#include "io/ifc_text.h"

namespace adit::io {

struct IfcUnits {
  double metres_per_unit = 1.0;
  double radians_per_unit = 1.0;
};

/// Throws Error with the place for units that are neither SI nor conversions of them.
IfcUnits read_ifc_units(const IfcText& text);

/// Where the file's coordinates (metres) stand in the site, from map conversion and the placements of a product: a turn
/// about the vertical and a shift. Throws Error with the place for placements that tilt and for conversions that scale.
struct IfcFrame {
  double turn_rad = 0.0;  ///< against the clock
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();

  Eigen::Vector2d plan(const Eigen::Vector2d& place_m) const {
    return Eigen::Rotation2Dd(turn_rad) * place_m + shift_m.head<2>();
  }
};
IfcFrame read_ifc_frame(const IfcText& text, const IfcInstance& product, const IfcUnits& units);

}  // namespace adit::io
