#pragma once
// Design sections of LandXML (CrossSects, DesignCrossSectSurf) as profiles along the axis.

#include <filesystem>
#include <string>
#include <vector>

#include "core/design/design_tunnel.h"

namespace adit::io {

/// Every CrossSect with a closed DesignCrossSectSurf of this name, or "name/side"; empty: the only closed one. Each
/// holds from its station. Throws Error with file and line when there is none, when a section or several alignments
/// have more than one, when points are no "Offset Elevation", when stations go back, and as Profile does.
std::vector<ProfileFrom> read_landxml_profiles(const std::filesystem::path& file, const std::string& surface);

}  // namespace adit::io
