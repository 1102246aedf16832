#pragma once
// Axes from LandXML 1.0 to 1.2 and its Inframodel dialect, and back. Plan: Line, Curve, Spiral (clothoid); grade line:
// PVI, ParaCurve, CircCurve. What changes geometry and is not one of these is refused by name, never approximated;
// everything else that is not read is listed.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/design/alignment.h"
#include "core/foundation/error.h"
#include "core/foundation/finding.h"

namespace adit::io {

/// One Alignment of a file: its geometry, or why it was refused, and all that a person should know about it.
struct LandXmlAlignment {
  std::string name;
  /// Metres, east and north as x and y. Without grade line when the file has none or it was refused; empty when the
  /// plan was refused.
  std::optional<Alignment> axis;
  std::optional<Error> refusal;        ///< why there is no axis
  std::optional<Error> grade_refusal;  ///< why the axis has no grade line, when the file has one
  double stated_length_m = 0.0;        ///< the attribute; 0 when absent
  Findings findings;                   ///< gaps, kinks, lengths that differ (warnings); what is not honoured (notes)
};

/// A file with all its alignments, in order.
struct LandXmlFile {
  std::string file;
  std::vector<LandXmlAlignment> alignments;
  Findings findings;  ///< trees outside the alignments that are not read (notes)
};

/// Reads every alignment. Throws Error with file and line when it is missing, no LandXML, not well-formed or its units
/// are unknown; a fault within one alignment is that alignment's refusal and leaves the others readable.
LandXmlFile read_landxml(const std::filesystem::path& file);

/// The alignment of that name, or the only one for an empty name. Throws its refusal, or Error listing the names; also
/// when it has no grade line.
Alignment choose_alignment(const LandXmlFile& file, const std::string& name);

/// LandXML 1.2 text of an axis in metres, with nine decimals so that reading it back is exact to a micrometre. Throws
/// Error for an element that turns first one way, then the other.
std::string landxml_text(const Alignment& alignment);

}  // namespace adit::io
