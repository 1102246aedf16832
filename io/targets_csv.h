#pragma once
// Targets found in scans: scan,id,x,y,z.

#include <filesystem>
#include <string>
#include <vector>

#include "core/georeference/control.h"

namespace adit::io {

/// Coordinates in the scan's own frame [m]. Separated by comma, semicolon or tab; header and lines beginning with # are
/// optional. Throws Error with line and column for anything that is no number, a target given twice in one scan (naming
/// both lines), columns named in another order, and a file without targets.
std::vector<TargetObservation> read_targets_csv(const std::filesystem::path& file);

/// The same with a header, six decimals.
std::string targets_csv_text(const std::vector<TargetObservation>& targets);

}  // namespace adit::io
