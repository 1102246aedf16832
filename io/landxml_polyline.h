#pragma once
// IrregularLine and Chain of a LandXML CoordGeom: straight pieces between points.

#include <string>
#include <vector>

#include "io/landxml_element.h"

namespace adit::io {

/// The pieces in order, named "IrregularLine 2, piece 1" and so on. Throws Error with the line when points are missing,
/// a name is that of no CgPoint, or the points do not begin and end where Start and End say (1 mm).
std::vector<LandXmlElement> read_landxml_polyline(const LandXmlNode& node, const std::string& name);

}  // namespace adit::io
