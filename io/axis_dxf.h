#pragma once
// Axes from a DXF drawing: one for each open line.

#include <filesystem>
#include <optional>

#include "io/axis_file.h"

namespace adit::io {

/// LINE, ARC, LWPOLYLINE and POLYLINE (with bulges, or with elevations), x east, y north, loose ones of a layer chained
/// as profiles are. An axis is named after its layer, with a number where the layer holds several, and runs as it was
/// drawn. Lines and bulges are taken as they stand, polylines without bulges as points (axis_from_points). Elevations
/// make the grade line, straight between corners; where all are zero there is none. Throws Error as the drawing's
/// reader does, and when it holds no open line.
AxisFile read_dxf_axes(const std::filesystem::path& file, const std::optional<double>& start_chainage_m);

}  // namespace adit::io
