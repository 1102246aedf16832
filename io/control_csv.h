#pragma once
// Control points: id,east,north,elevation.

#include <filesystem>
#include <string>
#include <vector>

#include "core/georeference/control.h"

namespace adit::io {

/// Separated by comma, semicolon or tab; header and lines beginning with # are optional. Throws Error with line and
/// column for anything that is no number, an id given twice (naming both lines), columns named in another order, and a
/// file without points.
std::vector<ControlPoint> read_control_csv(const std::filesystem::path& file);

/// The same with a header, six decimals.
std::string control_csv_text(const std::vector<ControlPoint>& points);

}  // namespace adit::io
