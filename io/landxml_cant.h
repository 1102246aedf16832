#pragma once
// Cant and Superelevation of a LandXML alignment.

#include <string>

#include "core/design/cant.h"
#include "core/design/horizontal_alignment.h"
#include "core/foundation/finding.h"
#include "io/landxml_node.h"

namespace adit::io {

struct LandXmlCant {
  Cant cant;  ///< empty when the file gives none
  Findings findings;
};

/// Cant: applied cant in millimetres (inches in Imperial files) on the higher rail, about rotationPoint ("center" when
/// it is not said). Superelevation: percent, about the axis, down towards the inside of `plan` where the full slope is
/// reached; linear between its stations. `subject` names the alignment. Throws Error with the line for what changes
/// geometry and cannot be honoured: both at once, several Cants, unknown transitions or pivots, stations out of order.
LandXmlCant read_landxml_cant(const LandXmlNode& alignment, const HorizontalAlignment& plan,
                              const std::string& subject);

}  // namespace adit::io
