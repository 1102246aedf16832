#pragma once
// The Units element of LandXML.

#include "io/landxml_node.h"

namespace adit::io {

/// Throws Error with the line when the element is missing or a unit is unknown.
LandXmlUnits read_landxml_units(const LandXmlNode& root);

}  // namespace adit::io
