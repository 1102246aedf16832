#pragma once
// A design line from a DXF drawing, and back.

#include <filesystem>
#include <string>

#include "core/design/profile.h"

namespace adit::io {

/// The closed line of a drawing: LINE, ARC, CIRCLE, LWPOLYLINE and POLYLINE with bulges, drawn with x to the right
/// looking up-chainage and y up. Loose entities of one layer are chained where they meet within 1 mm. $INSUNITS
/// (millimetres, centimetres, decimetres, metres, inches, feet, survey feet) is honoured; without it metres are meant.
/// Entities inside blocks are not read. The profile is named after file and layer. Throws Error when the drawing is
/// broken, and, listing the layers, when it holds no closed line on `layer` (empty: any) or several.
Profile read_dxf_profile(const std::filesystem::path& file, const std::string& layer = {});

/// Writes a drawing in metres with the line as one closed LWPOLYLINE.
void write_dxf_profile(const std::filesystem::path& file, const Profile& profile, const std::string& layer = "profile");

}  // namespace adit::io
