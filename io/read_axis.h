#pragma once
// Axes from whatever file holds them.

#include <filesystem>
#include <optional>

#include "io/axis_file.h"

namespace adit::io {

/// LandXML (.xml, .landxml), IFC 4.3 (.ifc), DXF lines, KOF lines, or a table of points (.csv, .txt). Formats without
/// chainages need that of their first point, those with refuse one. Errors are those of the format, with file and line.
AxisFile read_axis(const std::filesystem::path& file, const std::optional<double>& start_chainage_m = std::nullopt);

}  // namespace adit::io
