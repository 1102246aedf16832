#pragma once
// An axis as a table of points.

#include <filesystem>
#include <optional>

#include "io/axis_file.h"

namespace adit::io {

/// Rows of chainage,east,north,elevation. A header may name the columns in another order, with others between them
/// (which are listed); without chainage column the chainage of the first point is needed. Throws Error with file, line
/// and column for what is no number.
AxisFile read_axis_csv(const std::filesystem::path& file, const std::optional<double>& start_chainage_m);

}  // namespace adit::io
