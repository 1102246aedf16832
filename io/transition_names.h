#pragma once
// What formats call the transitions of curvature and of cant.

#include <optional>
#include <string>

#include "core/design/horizontal_element.h"

namespace adit::io {

/// LandXML's spiType and transitionType, in either spelling of the schema and any case; the reversed ones follow the
/// same laws. Empty for those that are not supported.
std::optional<HorizontalKind> landxml_transition(const std::string& word);

/// IFC's types of horizontal and cant segments that are transitions, but for clothoids, which only curvature has.
std::optional<HorizontalKind> ifc_transition(const std::string& word);

}  // namespace adit::io
