#pragma once
// Which points of a source take part in an iteration.

#include <cstddef>
#include <vector>

#include "core/registration/icp_cloud.h"

namespace adit {

/// Indices of the selected points, ascending; all when there are no more than the samples asked for.
std::vector<std::size_t> selected_points(const IcpCloud& source, const IcpOptions& options, int iteration);

}  // namespace adit
