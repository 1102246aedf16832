#pragma once
// A design line as a table of points: offset,height and an optional bulge.

#include <filesystem>
#include <string>

#include "core/design/profile.h"

namespace adit::io {

/// Points in order around the line [m], offset right positive looking up-chainage; a third column is the bulge of the
/// segment that follows (as in DXF). The first point may be repeated at the end or not. Separated by comma, semicolon,
/// tab or blanks; header and lines beginning with # are optional. The profile's name is the file's. Throws Error with
/// line and column, or with segments and place when the line is none.
Profile read_profile_csv(const std::filesystem::path& file);

/// The same with a header, nine decimals.
std::string profile_csv_text(const Profile& profile);

}  // namespace adit::io
