#pragma once
// Axes from LandXML 1.0 to 1.2 and its Inframodel dialect, and back. Plan: Line, Curve, Spiral (see HorizontalKind),
// IrregularLine, Chain; grade line: PVI, ParaCurve, UnsymParaCurve, CircCurve; StaEquation; Cant and Superelevation.
// What changes geometry and is not one of these is refused by name, never approximated; everything else that is not
// read is listed.

#include <filesystem>
#include <string>

#include "io/axis_file.h"

namespace adit::io {

/// Reads every alignment. Throws Error with file and line when it is missing, no LandXML, not well-formed or its units
/// are unknown; a fault within one alignment is that alignment's refusal and leaves the others readable.
AxisFile read_landxml(const std::filesystem::path& file);

/// LandXML 1.2 text of an axis in metres, with nine decimals so that reading it back is exact to a micrometre. Throws
/// Error for an element that turns first one way, then the other.
std::string landxml_text(const Alignment& alignment);

}  // namespace adit::io
