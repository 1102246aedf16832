#pragma once
// The one door to design lines.

#include <filesystem>
#include <string>

#include "core/design/profile.h"

namespace adit::io {

/// By ending: .csv and .txt as a table of points, .dxf as a drawing, whose `layer` may be named. Throws Error for other
/// endings and for what the readers refuse.
Profile read_profile(const std::filesystem::path& file, const std::string& layer = {});

}  // namespace adit::io
