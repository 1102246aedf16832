#pragma once
// One Line, Curve or Spiral of a LandXML CoordGeom.

#include <optional>
#include <string>

#include "core/design/horizontal_alignment.h"
#include "io/landxml_node.h"

namespace adit::io {

/// What the file says of one element, beside its geometry.
struct LandXmlElement {
  HorizontalElement geometry;  ///< no length: nothing between its points, to be left out
  Eigen::Vector2d stated_end;  ///< east, north [m]
  std::optional<double> stated_length_m;
  std::optional<double> stated_radius_m;   ///< of a Curve; its centre gives another one when they differ
  std::optional<double> stated_start_dir;  ///< as written, in the file's unit
  std::string place;                       ///< file and line
  bool of_polyline = false;                ///< a piece of an IrregularLine or Chain: it bends at its ends

  PlanPoint computed_end() const { return element_point(geometry, geometry.length_m); }
};

/// Reads a Line, Curve or Spiral; `name` is its name for messages ("Spiral 12"). Throws Error with the line.
LandXmlElement read_landxml_element(const LandXmlNode& node, const std::string& name);

}  // namespace adit::io
