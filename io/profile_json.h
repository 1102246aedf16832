#pragma once
// Design lines as JSON: lines and arcs whose places may be formulas of named sizes, and the library of such files.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/design/profile.h"

namespace adit::io {

/// Sizes by name; those given replace the file's own.
using ProfileSizes = std::map<std::string, double>;

/// { "name", "sizes": { "width": 9.0 }, "at_least": [["width", 0.1]], "where": [["r", "width/2"]], "start": [x, z],
/// "pieces": [ ... ] }, a piece one of
///   { "line": [x, z] }, { "arc": [x, z], "through": [x, z] }, { "arc": [x, z], "center": [x, z] } (the shorter way),
///   { "arc": [x, z], "bulge": b };
/// the last one ends at the start. Every number may be a formula (io/expression.h) of sizes and what "where" adds.
/// Throws Error with file and key for anything else, for sizes the file does not have or that fall below their limits,
/// and as Profile does.
Profile read_profile_json(const std::filesystem::path& file, const ProfileSizes& sizes = {});

/// A profile of the library by its name, "d_shape". Throws Error listing the names, or the sizes it takes.
Profile library_profile(const std::string& name, const ProfileSizes& sizes);

/// Names of the library with their sizes and defaults, for help: "d_shape (width 5, wall_height 2.5)".
std::vector<std::string> library_profiles();

}  // namespace adit::io
