#pragma once
// CoordGeom of a LandXML alignment: lines, arcs and clothoids from their coordinates.

#include <string>

#include "core/design/horizontal_alignment.h"
#include "core/foundation/finding.h"
#include "io/landxml_node.h"

namespace adit::io {

struct LandXmlPlan {
  HorizontalAlignment horizontal;
  Findings findings;
};

/// `subject` names the alignment in findings and errors: "alignment A50034A". Tangents come from coordinates;
/// directions of the file are only compared. Throws Error for elements of other kinds, gaps over 50 mm, elements that
/// turn the other way than their points say, and an axis that turns back on itself.
LandXmlPlan read_landxml_plan(const LandXmlNode& alignment, const std::string& subject);

}  // namespace adit::io
