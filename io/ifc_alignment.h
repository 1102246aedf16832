#pragma once
// Axes from IFC 4.3: IfcAlignment with its horizontal, vertical and cant segments.

#include <filesystem>

#include "io/axis_file.h"

namespace adit::io {

/// Reads every alignment from its business segments (IfcAlignmentHorizontalSegment and so on); curves drawn for
/// pictures are not looked at. Angles and radii of IFC count against the clock from east and are turned round; places
/// of IfcLocalPlacement and IfcMapConversion are followed. The first chainage is that of the alignment's first station
/// referent (4.3), or the start distance of drafts of 4.3, else 0; further referents with an incoming station become
/// station equations. Throws Error with file and line when the file is no IFC 4.3, broken, or its unit is unknown; a
/// fault within one alignment is that alignment's refusal.
AxisFile read_ifc_alignments(const std::filesystem::path& file);

}  // namespace adit::io
