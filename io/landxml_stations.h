#pragma once
// StaEquation of a LandXML alignment.

#include <string>

#include "core/design/horizontal_alignment.h"
#include "core/design/station_equations.h"
#include "core/foundation/finding.h"
#include "io/landxml_node.h"

namespace adit::io {

struct LandXmlStations {
  StationEquations stations;
  Findings findings;  ///< stations that are displayed twice or not at all, a staBack that differs
};

/// `subject` names the alignment. Throws Error with the line when an equation lacks a number or goes back.
LandXmlStations read_landxml_stations(const LandXmlNode& alignment, const HorizontalAlignment& plan,
                                      const std::string& subject);

}  // namespace adit::io
