#pragma once
// The segments of an IFC alignment as elements of ours.

#include <string>
#include <vector>

#include "core/design/cant.h"
#include "core/design/horizontal_alignment.h"
#include "core/design/vertical_alignment.h"
#include "core/foundation/finding.h"
#include "io/ifc_frame.h"

namespace adit::io {

/// Segments in order, of one kind (IfcAlignmentHorizontalSegment, ...).
using IfcSegments = std::vector<const IfcInstance*>;

/// `subject` names the alignment in findings and errors. All throw Error with the place for kinds that are not
/// supported and for gaps over 50 mm; gaps over 1 mm and kinks are warnings.
HorizontalAlignment plan_of(const IfcText& text, const IfcSegments& segments, const IfcUnits& units,
                            const IfcFrame& frame, double start_chainage_m, const std::string& subject,
                            Findings& findings);
VerticalAlignment grade_of(const IfcSegments& segments, const IfcUnits& units, double height_m, double start_chainage_m,
                           const std::string& subject, Findings& findings);
/// Edges are the rails: `base` is the RailHeadDistance in the file's unit.
Cant cant_of(const IfcSegments& segments, const IfcUnits& units, double base, double start_chainage_m);

}  // namespace adit::io
