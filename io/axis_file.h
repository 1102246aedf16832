#pragma once
// Axes of a file, whatever its format: what could be read, what was refused, and what a person should know.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/design/alignment.h"
#include "core/foundation/error.h"
#include "core/foundation/finding.h"

namespace adit::io {

/// One axis of a file: its geometry, or why it was refused.
struct AxisOfFile {
  std::string name;
  /// Metres, east and north as x and y. Without grade line when the file has none or it was refused; empty when the
  /// plan was refused.
  std::optional<Alignment> axis;
  std::optional<Error> refusal;        ///< why there is no axis
  std::optional<Error> grade_refusal;  ///< why the axis has no grade line, when the file has one
  std::optional<Error> cant_refusal;   ///< why the axis has no cant, when the file has some
  Findings findings;                   ///< gaps, kinks, lengths that differ (warnings); what is not honoured (notes)
};

/// A file with all its axes, in order.
struct AxisFile {
  std::string file;
  std::string format;  ///< "LandXML", for people
  std::vector<AxisOfFile> axes;
  Findings findings;  ///< what of the file is not read (notes)
};

/// The axis of that name, or the only one for an empty name. Throws its refusal, or Error listing the names.
const AxisOfFile& named_axis(const AxisFile& file, const std::string& name);

/// A note where the grade line leaves more than a metre of the axis without elevation, a warning where more than half.
Findings grade_coverage(const Alignment& axis);

/// As named_axis(); throws also when the axis has no grade line.
Alignment choose_alignment(const AxisFile& file, const std::string& name);

}  // namespace adit::io
