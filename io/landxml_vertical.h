#pragma once
// ProfAlign of a LandXML alignment: the grade line.

#include <optional>
#include <string>

#include "core/design/vertical_alignment.h"
#include "core/foundation/finding.h"
#include "io/landxml_node.h"

namespace adit::io {

struct LandXmlGrade {
  VerticalAlignment vertical;  ///< empty when the file gives none
  Findings findings;
};

/// `subject` names the alignment. Throws Error for other curves, several grade lines, and points that make no grade
/// line.
LandXmlGrade read_landxml_grade(const LandXmlNode& alignment, const std::string& subject);

}  // namespace adit::io
