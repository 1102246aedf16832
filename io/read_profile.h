#pragma once
// The one door to design lines.

#include <filesystem>
#include <string>
#include <vector>

#include "core/design/design_tunnel.h"
#include "io/profile_json.h"

namespace adit::io {

/// By ending: .csv and .txt as a table of points, .dxf as a drawing, whose `layer` may be named, .json as lines and
/// arcs, whose `sizes` may be given. Throws Error for other endings, for a layer or sizes that the format does not
/// have, and for what the readers refuse.
Profile read_profile(const std::filesystem::path& file, const std::string& layer = {}, const ProfileSizes& sizes = {});

/// The same as profiles along the axis: one that holds from from_m, or, of LandXML (.xml), every design section that
/// `layer` names, each from its own station. `interpolated`: each changes into the next one, as into what follows them.
std::vector<ProfileFrom> read_profiles(const std::filesystem::path& file, const std::string& layer,
                                       const ProfileSizes& sizes, double from_m, bool interpolated);

}  // namespace adit::io
